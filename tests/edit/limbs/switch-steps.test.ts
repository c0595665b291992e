/** Tangents of all keys of a take whose limbs are switched. */
import { expect, it } from 'vitest';
import { isChange } from '../../../src/edit/change.ts';
import { keyLimb, switchLimb } from '../../../src/edit/commands/beside/limbs.ts';
import { setTangents } from '../../../src/edit/commands/tangents.ts';
import { onEachCharacter } from '../../../src/edit/in-turn.ts';
import { limbInfos } from '../../../src/evaluate/limbs/infos.ts';
import { dofCountOf } from '../../../src/evaluate/pose.ts';
import type { Document } from '../../../src/model/document.ts';
import { firstGoalChannel, withGoalChannels } from '../../../src/model/takes/goals.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { HERO, heroOf, run, withLegs } from './walker.ts';

const at = (timeSeconds: number) => ({ ...HERO, limb: 0, timeSeconds });
const held = run(withLegs(), switchLimb, { ...at(0.4), to: 'ik' });
const switched = run(held, switchLimb, { ...at(1.2), to: 'fk' });
const BLEND = firstGoalChannel(dofCountOf(heroOf(switched)), 0);
const TIMES = [0, 0.2, 0.39, 0.4, 0.6, 1.1, 1.19, 1.2, 1.5];

const channelsOf = (document: Document) =>
  withGoalChannels(heroOf(document).takes[0], dofCountOf(heroOf(document))).channels;
const allKeys = (document: Document) =>
  channelsOf(document).flatMap((one, channel) =>
    one.kind === 'keys' ? [{ channel, indices: [...one.times.keys()] }] : [],
  );
const AUTO = { ...HERO, side: 'both', kind: 'auto' } as const;

it('keys that switch a limb stay steps where all keys are made auto, and it is said how many', () => {
  const keys = allKeys(switched);
  const blends = (document: Document) => TIMES.map((time) => limbInfos(heroOf(document), time)[0].blend);
  const change = setTangents.run(switched, { ...AUTO, keys });
  if (!isChange(change)) throw new Error('It says which keys are selected.');
  expect(blends(change.document)).toEqual(blends(switched));
  expect(channelsOf(change.document)[BLEND]).toBe(channelsOf(switched)[BLEND]);
  expect(change.switches).toBe(new Set(keysOf(channelsOf(switched)[BLEND]).times).size);
  expect(change.keys?.find(({ channel }) => channel === BLEND)).toEqual(keys.find(({ channel }) => channel === BLEND));
  expect(onEachCharacter(setTangents, '').run(switched, [{ ...AUTO, keys }])).toMatchObject({
    switches: change.switches,
  });
});

it('keys that switch a limb change as any others where only such keys are meant', () => {
  const keys = allKeys(switched).filter(({ channel }) => channel === BLEND);
  const change = setTangents.run(switched, { ...AUTO, keys });
  if (!isChange(change)) throw new Error('It says which keys are selected.');
  expect(change).not.toHaveProperty('switches');
  expect(limbInfos(heroOf(change.document), 0.8)[0].blend).toBeLessThan(1);
});

it('a goal jumps from one space to the next whatever its tangents are', () => {
  const keyed = run(held, keyLimb, { ...at(0.8), space: 'hips' });
  const tx = BLEND + 1;
  const stepsOf = (document: Document) => {
    const { times, values } = keysOf(channelsOf(document)[tx]);
    return Array.from(times).flatMap((time, k) => (time === 0.8 ? [values[k]] : []));
  };
  expect(stepsOf(keyed)).toHaveLength(2);
  const all = run(keyed, setTangents, { ...AUTO, keys: allKeys(keyed) });
  expect(stepsOf(all)).toEqual(stepsOf(keyed));
  for (const time of [0.5, 0.7, 0.799, 0.8]) {
    const [before] = limbInfos(heroOf(keyed), time);
    expect(limbInfos(heroOf(all), time)[0]).toMatchObject({ blend: before.blend, space: before.space });
  }
});
