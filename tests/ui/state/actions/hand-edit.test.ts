import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { HandEdit } from '../../../../src/ui/state/actions/hand-edit.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

let pressKey: ((key: string) => void) | undefined;

beforeEach(() => {
  vi.stubGlobal('window', {
    addEventListener: (_type: string, listener: (event: object) => void) => {
      pressKey = (key) => listener({ key, preventDefault: () => {}, stopPropagation: () => {} });
    },
    removeEventListener: () => {
      pressKey = undefined;
    },
  });
  vi.stubGlobal('document', { activeElement: null });
  vi.stubGlobal('HTMLInputElement', class {});
});
afterEach(() => void vi.unstubAllGlobals());

function hand(stillHolds?: () => boolean) {
  const { wb } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1]) })));
  const edit = new HandEdit(wb.store, wb.messages, stillHolds);
  const drag = (value: number, characterId = 'c1') =>
    edit.preview(setDofs, { characterId, dofs: [{ index: 3, value }], timeSeconds: 0 });
  return { wb, edit, drag, value: () => wb.store.document.characters[0].pose[3] };
}

it('makes one step of a drag', () => {
  const { wb, edit, drag, value } = hand();
  for (const v of [0.1, 0.2, 0.3]) drag(v);
  edit.commit();
  expect(value()).toBe(0.3);
  wb.store.undo();
  expect(value()).toBe(0);
  expect(wb.store.undoLabel).toBeUndefined();
});

it('restores everything on Escape, until the mouse is released', () => {
  const { wb, edit, drag, value } = hand();
  drag(0.5);
  pressKey?.('Escape');
  expect(value()).toBe(0);
  drag(0.7);
  expect(value()).toBe(0);
  edit.commit();
  expect(wb.store.undoLabel).toBeUndefined();
  drag(0.2);
  edit.commit();
  expect(value()).toBe(0.2);
});

it('continues in a new step if something else has ended it', () => {
  const { wb, edit, drag, value } = hand();
  drag(0.5);
  wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 4, value: 1 }], timeSeconds: 0 });
  drag(0.6);
  edit.commit();
  expect(value()).toBe(0.6);
  expect(wb.store.document.characters[0].pose[4]).toBe(1);
  wb.store.undo();
  expect(value()).toBe(0.5);
});

it('ends if something else has ended it, when it depends on the document at the press', () => {
  const { wb, edit, drag, value } = hand(() => true);
  drag(0.5);
  wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 4, value: 1 }], timeSeconds: 0 });
  expect(edit.cancelled).toBe(true);
  drag(0.6);
  expect(value()).toBe(0.5);
  expect(edit.cancelled).toBe(true);
  const { undoLabel } = wb.store;
  edit.commit();
  expect([value(), edit.cancelled, wb.store.undoLabel]).toEqual([0.5, false, undoLabel]);
});

it('keeps what was undone meanwhile redoable', () => {
  const { wb, edit, drag, value } = hand(() => true);
  drag(0.5);
  wb.store.undo();
  drag(0.6);
  edit.commit();
  expect(value()).toBe(0);
  wb.store.redo();
  expect(value()).toBe(0.5);
});

it('does not start if its object no longer exists', () => {
  const { wb, edit, drag, value } = hand(() => false);
  drag(0.5);
  expect([value(), edit.cancelled]).toEqual([0, true]);
  edit.commit();
  expect(wb.store.undoLabel).toBeUndefined();
});

it('turns a refusal into a message', () => {
  const { wb, drag } = hand();
  drag(0.5, 'nobody');
  expect(wb.messages.list.get()).toMatchObject([{ severity: 'warning' }]);
});
