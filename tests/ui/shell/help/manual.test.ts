/** Which page of the manual F1 opens, and that each is there. */
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { manualFiles } from '../../../../plugins/manual.ts';
import { MANUAL_PAGES, openManual } from '../../../../src/ui/shell/help/manual.ts';
import { EXPLAINED_PAGES, PROBLEM_PAGES } from '../../../../src/ui/state/manual-link.ts';
import { workbench } from '../../builders.ts';

const files = await manualFiles();

it.each([...new Set([...MANUAL_PAGES, ...EXPLAINED_PAGES, ...PROBLEM_PAGES])])(
  '%s, which the page opens, is in the manual',
  (address) => {
    const [path = '', anchor] = address.split('#');
    expect(files.get(path)).toContain(anchor === undefined ? '<h1 ' : ` id="${anchor}"`);
  },
);

describe('the page that the manual opens at', () => {
  let opened: string[] = [];
  let isBlocked = false;
  beforeEach(() => {
    [opened, isBlocked] = [[], false];
    const open = (address: string) => {
      opened.push(address);
      return isBlocked ? null : {};
    };
    vi.stubGlobal('window', { open });
    vi.stubGlobal('document', { activeElement: null, querySelectorAll: () => [] });
  });
  afterEach(() => void vi.unstubAllGlobals());

  it('the manual opens with its contents, and by key with the page about the mode, in the inspector’s place', () => {
    const { wb } = workbench();
    openManual(wb, false);
    expect(wb.manual.get()).toEqual({ page: 'index.html' });
    vi.stubGlobal('document', { activeElement: null, querySelectorAll: () => [{ dataset: { panel: 'viewport' } }] });
    wb.posing.mode.set('ik');
    openManual(wb, true);
    expect(wb.manual.get()).toEqual({ page: 'guide/posing.html#ik' });
    expect(opened).toEqual([]);
  });

  it('before a dialog the manual opens with the page about it, in a window', () => {
    const { wb } = workbench();
    wb.dialog.set('retarget');
    openManual(wb, true);
    expect(opened).toEqual(['./manual/guide/capture-and-review.html#retarget']);
    expect(wb.manual.get()).toBeUndefined();
  });

  it('a manual that the browser blocks is told', () => {
    isBlocked = true;
    const { wb } = workbench();
    wb.dialog.set('retarget');
    openManual(wb, false);
    expect(wb.messages.list.get().map(({ text }) => text)).toEqual([expect.stringContaining('blocked')]);
  });
});
