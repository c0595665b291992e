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

  it('the manual opens with its contents, with the page about the open dialog by key', () => {
    const { wb } = workbench();
    openManual(wb, false);
    openManual(wb, true);
    wb.dialog.set('retarget');
    openManual(wb, true);
    expect(opened).toEqual(
      ['index.html', 'index.html', 'guide/capture-and-review.html#retarget'].map((p) => `./manual/${p}`),
    );
  });

  it('a manual that the browser blocks is told', () => {
    isBlocked = true;
    const { wb } = workbench();
    openManual(wb, false);
    expect(wb.messages.list.get().map(({ text }) => text)).toEqual([expect.stringContaining('blocked')]);
  });
});
