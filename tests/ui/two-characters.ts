/** A walker and a flyer, each with a take; the flyer's starts half a second into it. */
import type { Character } from '../../src/model/document.ts';
import { channel, character, documentOf, skeleton, take, workbench } from './builders.ts';

export const OFFSET = 0.5;

/** Channels 0 to 5: translation and rotation of the root; 6 to 8: rotation of the second joint. */
export function twoCharacters(change: Partial<Character> = {}): readonly [Character, Character] {
  const walker = character({
    id: 'walker',
    name: 'Walker',
    skeleton: skeleton(['hips', -1], ['leg', 0]),
    takes: [
      take([0, 2], channel(0, 1, 2), channel(0, 2), channel(0, 1), ...[3, 4, 5].map(() => channel(1)), channel(0, 1)),
    ],
  });
  const flyer = character({
    id: 'flyer',
    name: 'Flyer',
    skeleton: skeleton(['body', -1], ['wing', 0]),
    takes: [
      take([0, 2], channel(0, 1, 2), channel(0.5, 1.5), ...[2, 3, 4, 5].map(() => channel(0.5)), channel(0.5, 1)),
    ],
    timeOffsetSeconds: OFFSET,
    ...change,
  });
  return [walker, flyer];
}

/** With joint 1 of either selected; the flyer is active. */
export function withTwoCharacters(change: Partial<Character> = {}) {
  const { wb } = workbench(documentOf(...twoCharacters(change)), { range: [0, 2], framesPerSecond: 10 });
  wb.store.select({ characterId: 'flyer', joint: 1, beside: [{ characterId: 'walker', joint: 1 }] });
  return wb;
}
