/** Whether characters as FBX are where they are here, as our own reader sees them, and three.js at frames. */
import { expect } from 'vitest';
import { DEFAULT_SPACE } from '../../../src/model/space.ts';
import {
  farthestOf,
  farthestVertex,
  fbxOf,
  type Places,
  placesOf,
  seenByThree,
  seenByUs,
  upright,
} from '../../helpers/fbx.ts';
import type { Named } from '../glb/many-characters.ts';

/** So many times this are nowhere near each other. */
const GOLDEN = 0.6180339887498949;
/** Of the tolerance: what is fitted may be off by some of it, in writing and in reading; the rest is exact. */
const MOST = 0.6;

/** Expects joints and vertices within the tolerance at times of the first take; of captures, at frames. */
export function expectSeen({ name, character }: Named, count = 20): void {
  const made = fbxOf(character);
  const { tolerance } = made.report;
  const take = character.takes.at(0);
  const [start, end] = take?.range ?? [0, 0];
  const frames = take?.samples;
  const wanted = Array.from({ length: count }, (_, i) => {
    const time = start + (end - start) * (((i + 0.37) * GOLDEN) % 1);
    if (!frames) return time;
    const { startSeconds, frameSeconds } = frames;
    return startSeconds + frameSeconds * Math.round((time - startSeconds) / frameSeconds);
  });
  // Of few frames, each once.
  const times = [...new Set(wanted)];
  const turned = (places: Places) => ((character.space ?? DEFAULT_SPACE).up === 'z' ? upright(places) : places);
  const ours = times.map((time) => turned(placesOf(character, take ? 0 : -1, time)));
  const { seen } = seenByUs(character, made);
  const theirs = times.map((time) => seen(take ? 0 : -1, time));
  ours.forEach(({ joints }, i) => {
    expect(farthestOf(joints, theirs[i].joints) / tolerance, `${name} at ${times[i]}`).toBeLessThan(MOST);
  });
  const few = [0, 1, 2].map((i) => i * Math.floor(times.length / 3));
  const vertices = (all: readonly Places[]) => few.map((i) => all[i].vertices);
  expect(farthestVertex(vertices(ours), vertices(theirs)) / tolerance, name).toBeLessThan(MOST);
  if (!frames) return;
  const three = seenByThree(character, made);
  ours.forEach(({ joints }, i) => {
    expect(farthestOf(joints, three(0, times[i]).joints) / tolerance, `${name} in three.js`).toBeLessThan(MOST);
  });
}
