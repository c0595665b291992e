import { describe, expect, it } from 'vitest';
import { copyKeys } from '../../../../src/edit/keys/clipboard.ts';
import { keysOf, restChannel } from '../../../../src/model/takes/take.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

/** Three of the root, then three for each joint; only the first leg has keys. */
const channels = Array.from({ length: 12 }, (_, c) => (c >= 6 && c < 9 ? channel(0, 1) : restChannel()));
const wasp = character({
  skeleton: skeleton(['hips', -1], ['leg_l', 0], ['leg_r', 0]),
  takes: [take([0, 2], ...channels)],
});
const copied = (...from: number[]) =>
  copyKeys(
    wasp.takes[0],
    from.map((c) => ({ channel: c, indices: [0, 1] })),
  );

function pasted(joint: number | undefined, from: readonly number[], action = 'timeline.paste') {
  const { wb } = workbench(documentOf(wasp));
  if (joint !== undefined) wb.store.select({ characterId: 'c1', joint });
  wb.timeline.copied = copied(...from);
  wb.transport.update((p) => ({ ...p, timeSeconds: 0.5 }));
  runAction(wb, action);
  const after = wb.store.document.characters[0].takes[0].channels;
  return {
    into: after.flatMap((c, i) => (keysOf(c).times.includes(0.5) ? i : [])),
    says: wb.messages.passing.get(),
  };
}

describe('pasted keys', () => {
  it('pasted keys go into the channels that they were copied from, where these are listed', () => {
    expect(pasted(undefined, [6, 7]).into).toEqual([6, 7]);
    expect(pasted(1, [6, 7]).into).toEqual([6, 7]);
  });

  it('pasted keys go into the same DOFs of the joint that is listed instead, which needs no keys', () => {
    expect(pasted(2, [6]).into).toEqual([9]);
    expect(pasted(2, [6, 8]).into).toEqual([9, 11]);
    expect(pasted(2, [7], 'timeline.pasteInto').into).toEqual([9, 10, 11]);
  });

  it('pasted keys go nowhere unseen: it is said whose they are', () => {
    const { wb } = workbench(documentOf(wasp));
    wb.store.select({ characterId: 'c1', joint: 2 });
    wb.timeline.change({ filter: 'rz' });
    wb.timeline.copied = copied(6);
    runAction(wb, 'timeline.paste');
    expect(wb.store.document.characters[0]).toBe(wasp);
    expect(wb.messages.passing.get()).toBe(
      'These keys are from leg_l rx, and no listed channel matches it. Select its joint, or list all channels.',
    );
  });
});
