import { expect, it } from 'vitest';
import { rigTool } from '../../../../src/ui/editors/rig/rig-tool.ts';
import type { CanvasPointer } from '../../../../src/ui/editors/viewport/canvas-tools.ts';
import type { Hit } from '../../../../src/view/picking/picking.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

const bones = skeleton(['hips', -1], ['leg', 0]);
const AT: CanvasPointer = {
  ...{ clientX: 0, clientY: 0, button: 0, pointerType: 'mouse' },
  ...{ altKey: false, shiftKey: false, ctrlKey: false, metaKey: false },
};

/** The selection after a click in rig mode on what `hit` says, with a joint of the first of two characters selected. */
function clicked(hit: Hit | undefined, keys: Partial<CanvasPointer> = {}) {
  const second = character({ id: 'c2', name: 'second', skeleton: bones });
  const { wb } = workbench(documentOf(character({ skeleton: bones }), second));
  wb.posing.mode.set('rig');
  wb.store.select({ characterId: 'c1', joint: 1 });
  const viewport = { ...wb.viewport, pointing: { pick: () => hit } };
  // The rest of the viewport needs a browser.
  rigTool({ ...wb, viewport: viewport as unknown as typeof wb.viewport }).click?.({ ...AT, ...keys });
  return wb.store.selection;
}

it('a click on a character’s name in rig mode selects that character', () => {
  expect(clicked({ characterId: 'c2', placement: 0 })).toEqual({ characterId: 'c2', placement: 0 });
});

it('a click on the ground in rig mode keeps the character, and with Shift its joints too', () => {
  expect(clicked(undefined)).toEqual({ characterId: 'c1' });
  expect(clicked(undefined, { shiftKey: true })).toEqual({ characterId: 'c1', joint: 1 });
});

it('Shift+click on a character’s name in rig mode keeps the selected joints', () => {
  expect(clicked({ characterId: 'c2', placement: 0 }, { shiftKey: true })).toEqual({ characterId: 'c1', joint: 1 });
});
