/** Keys hold their tolerance where nothing was measured: between rows, after steps, for every vertex and every axis. */
import { expect, it } from 'vitest';
import { character, joint } from '../../helpers/builders.ts';
import { glbOf } from '../../helpers/glb.ts';
import { offBy } from '../../helpers/glb-off.ts';
import { bySamplers } from '../../helpers/glb-samplers.ts';
import { describeShared } from '../../helpers/shared.ts';
import { expectWithin } from './at-unseen-times.ts';
import { movedCharacters, type Named, randomTake } from './many-characters.ts';

function named(wanted: string, seconds = 1): Named {
  const [found] = movedCharacters((name) => name === wanted);
  if (!found) throw new Error(`There is no character ${wanted}.`);
  // A part of the take: more of it takes longer, and shows nothing else.
  const takes = found.character.takes.map((take) => ({ ...take, range: [0, seconds] as const }));
  return { ...found, character: { ...found.character, takes } };
}

describeShared('GLB files at unseen times', () => {
  it.each(['linear', 'cubic'] as const)('joints at ends turn with %s keys as they do here', (keys) => {
    expectWithin(named('hand.axskel calm'), { keys });
  });

  it.each(['linear', 'cubic'] as const)('vertices that follow nine joints are where %s keys put them', (keys) => {
    expectWithin(named('nine calm', 0.4), { keys });
  });

  it('the four strongest attachments hold the tolerance where they are all there is', () => {
    expectWithin(named('nine calm', 0.4), { keys: 'linear', influences: 4 });
  });

  it('cycles that begin again at nearly the same time, differently rounded, all jump', () => {
    expectWithin(named('hand.axskel wild'), { keys: 'linear' });
  });
});

it('a step long after the start is a step, where floats are coarser than the time between its two keys', () => {
  const skeleton = { name: 'one', joints: [joint(-1), joint(0)] };
  const take = randomTake(skeleton, 5, 1, { angle: 0.4, seconds: 2, keysPerSecond: 1, isWild: true });
  const later = 4000;
  const channels = take.channels.map((channel) =>
    channel.kind === 'keys' ? { ...channel, times: channel.times.map((t) => later + t) } : channel,
  );
  const own = character({
    skeleton,
    takes: [
      { ...take, range: [0, later + 2], channels: channels.map((c) => ({ ...c, extrapolateIn: 'constant' as const })) },
    ],
    shownTake: 0,
  });
  const made = glbOf(own);
  const times = Array.from({ length: 200 }, (_, i) => later + (i + 0.37) / 100);
  const off = offBy(own, made, bySamplers(made, 'slerp'), 0, times);
  expect(off.joints).toBeLessThanOrEqual(made.report.tolerance);
});
