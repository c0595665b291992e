import { expect, it } from 'vitest';
import { PlotScene } from '../../../../src/ui/editors/curves/plot-scene.ts';
import { isFaint } from '../../../../src/ui/editors/curves/scene/scene.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

/** Root translation and five joints of three DOFs: 18 channels, all keyed. */
const crowd = character({
  skeleton: skeleton(['hips', -1], ['a', 0], ['b', 1], ['c', 2], ['d', 3]),
  takes: [take([0, 1], ...Array.from({ length: 18 }, () => channel(0, 1)))],
});

function bright(joint: number | undefined, change = {}): readonly number[] {
  const { wb } = workbench(documentOf(crowd));
  wb.store.select({ characterId: crowd.id, ...(joint !== undefined && { joint }) });
  wb.timeline.change({ list: 'all', ...change });
  const { scene } = new PlotScene(wb);
  return scene.lines.filter((line) => !isFaint(scene, line)).map((line) => line.channel);
}

it('among all channels those of the selected joint are in front, or the root’s', () => {
  expect(bright(2)).toEqual([9, 10, 11]);
  expect(bright(undefined)).toEqual([0, 1, 2, 3, 4, 5]);
});

it('a few lines are all alike, and so are isolated ones', () => {
  expect(bright(2, { filter: 'hips' })).toEqual([0, 1, 2, 3, 4, 5]);
  expect(bright(2, { filter: 'rx' })).toEqual([3, 6, 9, 12, 15]);
  expect(bright(2, { isolated: [0, 4, 8] })).toEqual([0, 4, 8]);
});

it('a line with selected keys is in front', () => {
  const { wb } = workbench(documentOf(crowd));
  wb.store.select({ characterId: crowd.id, joint: 2, keys: [{ channel: 0, indices: [0] }] });
  wb.timeline.change({ list: 'all' });
  const { scene } = new PlotScene(wb);
  expect(isFaint(scene, scene.lines[0])).toBe(false);
  expect(isFaint(scene, scene.lines[1])).toBe(true);
});
