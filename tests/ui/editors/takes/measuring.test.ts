import { describe, expect, it } from 'vitest';
import { setTimeOffset } from '../../../../src/edit/commands/characters.ts';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import type { Character } from '../../../../src/model/document.ts';
import { Measuring } from '../../../../src/ui/editors/takes/measuring.ts';
import { listOfTakes } from '../../../../src/ui/editors/takes/play.ts';
import { compareTakes } from '../../../../src/ui/editors/takes/start-comparison.ts';
import { character, documentOf, skeleton, takeOfValues } from '../../../helpers/builders.ts';
import { workbench } from '../../builders.ts';

/** Three joints at x; DOFs that its take doesn't drive can be posed. */
function take(id: string, x: number): Character {
  return character({ id, name: id, skeleton: skeleton(3), takes: [takeOfValues(id, [x])], shownTake: 0 });
}

function compared() {
  const { wb } = workbench(documentOf(take('a', 0), take('b', 2), take('c', 7)));
  const measuring = new Measuring(wb);
  const [a, b] = listOfTakes(wb);
  compareTakes(wb, a, b);
  /** The next result. */
  const next = () =>
    new Promise<number | undefined>((resolve) => {
      const stop = measuring.result.subscribe((result) => {
        stop();
        resolve(result?.distances?.mean[0]);
      });
    });
  return { wb, measuring, next };
}

describe('the distance of two compared takes', () => {
  it('the distance of two compared takes is measured once visible', async () => {
    const { measuring, next } = compared();
    expect(measuring.result.get()).toBeUndefined();
    const result = next();
    measuring.setVisible(true);
    expect(await result).toBe(2);
    expect(measuring.result.get()?.warped).toBeCloseTo(2, 12);
  });

  it('the distance of two compared takes is measured again when either take or the alignment changes', async () => {
    const { wb, measuring, next } = compared();
    let result = next();
    measuring.setVisible(true);
    await result;
    result = next();
    wb.timeline.takes.distances.update((now) => ({ ...now, alignment: 'root' }));
    expect(await result).toBe(0);
    result = next();
    // The middle joint bends: only the last of the three moves.
    wb.store.apply(setDofs, { characterId: 'b', dofs: [{ index: 6, value: Math.PI }], timeSeconds: 0 });
    expect(await result).toBeCloseTo(2 / 3, 6);
    result = next();
    wb.store.apply(setTimeOffset, { characterId: 'a', seconds: 9 });
    // They don't overlap in time any more.
    expect(await result).toBeUndefined();
    expect(measuring.result.get()?.match.first).toHaveLength(3);
  });

  it('the distance of two compared takes ends with the comparison', async () => {
    const { wb, measuring, next } = compared();
    let result = next();
    measuring.setVisible(true);
    await result;
    result = next();
    wb.timeline.takes.comparison.set(undefined);
    expect(await result).toBeUndefined();
    expect(measuring.result.get()).toBeUndefined();
  });
});
