import { afterEach, expect, it, vi } from 'vitest';
import { removeJoint } from '../../../../src/edit/commands/rig.ts';
import type { Skeleton } from '../../../../src/model/skeleton/skeleton.ts';
import { dragFreely } from '../../../../src/ui/editors/rig/joint-drags.ts';
import { riggedNow } from '../../../../src/ui/editors/rig/rigged.ts';
import { character, documentOf, skeleton } from '../../builders.ts';
import { ikPage } from '../ik/ik-page.ts';

const bare = skeleton(['hips', -1], ['leg_l', 0], ['leg_r', 0]);
/** With more digits than a drag has. */
const bones: Skeleton = {
  ...bare,
  joints: bare.joints.map((one, j) =>
    j === 0 ? one : { ...one, offset: [0.123456789 * (2 * j - 3), -1.00000007, 0] },
  ),
};
const HELD = { button: 0, pointerType: 'mouse', altKey: false, shiftKey: false, ctrlKey: false, metaKey: false };

afterEach(() => void vi.unstubAllGlobals());

it.each([
  ['one joint', []],
  ['several joints', [1]],
])('%s dragged and brought back in rig mode changes nothing, to the last digit', (_, others) => {
  const { wb } = ikPage(documentOf(character({ skeleton: bones })));
  wb.store.select({ characterId: 'c1', joint: 2, ...(others.length && { others }) });
  const { document } = wb.store;
  const rigged = riggedNow(wb);
  const at = { clientX: 12, clientY: 100, ...HELD };
  const drag = rigged && dragFreely(wb, rigged, 2, at);
  drag?.move({ ...at, clientX: 40, clientY: 61 });
  expect(wb.store.document).not.toBe(document);
  drag?.move(at);
  drag?.end(at);
  expect(wb.store.document).toEqual(document);
  expect(wb.store.undoLabel).toBeUndefined();
});

it('a joint dragged in rig mode while another one is deleted stays where it got, and no other moves in its place', () => {
  const { wb } = ikPage(documentOf(character({ skeleton: bones })));
  wb.store.select({ characterId: 'c1', joint: 1 });
  const rigged = riggedNow(wb);
  const at = { clientX: -12, clientY: 100, ...HELD };
  const drag = rigged && dragFreely(wb, rigged, 1, at);
  drag?.move({ ...at, clientX: 40, clientY: 61 });
  wb.store.apply(removeJoint, { characterId: 'c1', joint: 1, children: 'too', skin: 'stays', timeSeconds: 0 });
  const { document } = wb.store;
  expect(document.characters[0].skeleton?.joints.map(({ name }) => name)).toEqual(['hips', 'leg_r']);
  drag?.move({ ...at, clientX: 70, clientY: 31 });
  drag?.end({ ...at, clientX: 70, clientY: 31 });
  expect(wb.store.document).toBe(document);
  wb.store.undo();
  expect(wb.store.undoLabel).toBe('Move leg_l');
});
