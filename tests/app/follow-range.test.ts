import { expect, it } from 'vitest';
import { followRange } from '../../src/app/follow-range.ts';
import { showTake } from '../../src/edit/commands/characters.ts';
import { keyPose } from '../../src/edit/commands/keying.ts';
import { setTakeRange } from '../../src/edit/commands/take.ts';
import { DEFAULT_PLAYBACK } from '../../src/edit/playback.ts';
import { Store } from '../../src/edit/store.ts';
import { rangeOfTakes, startSeconds } from '../../src/model/document.ts';
import { observable } from '../../src/ui/widgets/observable.ts';
import { character, documentOf, takeOfValues } from '../helpers/builders.ts';

const walking = character({
  takes: [takeOfValues('walk', [0], [1, 3]), takeOfValues('run', [0], [-1, 2])],
  shownTake: 0,
});

function following() {
  const store = new Store();
  const transport = observable(DEFAULT_PLAYBACK);
  followRange(store, transport);
  return { store, transport };
}

it('uses the range of the first take, and of a selected take', () => {
  const { store, transport } = following();
  store.replace('Open', documentOf(walking));
  expect(transport.get().range).toEqual([1, 3]);
  store.apply(showTake, { characterId: 'c1', take: 1 });
  expect(transport.get().range).toEqual([-1, 2]);
  store.undo();
  expect(transport.get().range).toEqual([1, 3]);
});

it('spans all characters, each with its start time', () => {
  const { store, transport } = following();
  const later = { ...walking, id: 'c2', timeOffsetSeconds: -4 };
  store.replace('Open', documentOf(walking, later));
  expect(transport.get().range).toEqual([1, 7]);
});

it('keeps a range that was set by hand', () => {
  const { store, transport } = following();
  store.replace('Open', documentOf(walking));
  transport.update((now) => ({ ...now, range: [1.5, 2] }));
  store.apply(showTake, { characterId: 'c1', take: 1 });
  expect(transport.get().range).toEqual([1.5, 2]);
});

it('stops if nothing is left to play', () => {
  const { store, transport } = following();
  store.replace('Open', documentOf(walking));
  transport.update((now) => ({ ...now, playing: true }));
  store.replace('Open', documentOf(character()));
  expect(transport.get().playing).toBe(false);
});

it('follows the range of an edited take', () => {
  const { store, transport } = following();
  store.replace('Open', documentOf(walking));
  store.apply(setTakeRange, { characterId: 'c1', range: [0, 5] });
  expect(transport.get().range).toEqual([0, 5]);
});

it('has a range for keying poses without any take', () => {
  const { store, transport } = following();
  store.replace('Open', documentOf(character()));
  expect(transport.get().range).toEqual([0, 2]);
});

it('keeps range and time when the first key creates a take, and when that is undone', () => {
  const { store, transport } = following();
  store.replace('Open', documentOf(character()));
  transport.update((now) => ({ ...now, range: [0, 4], timeSeconds: 3 }));
  store.apply(keyPose, { characterId: 'c1', timeSeconds: 3, playedRange: transport.get().range });
  expect(transport.get()).toMatchObject({ range: [0, 4], timeSeconds: 3 });
  store.undo();
  expect(transport.get()).toMatchObject({ range: [0, 4], timeSeconds: 3 });
});

it('resets the range for another character without a take', () => {
  const { store, transport } = following();
  store.replace('Open', documentOf(walking));
  transport.update((now) => ({ ...now, timeSeconds: 2.7, playing: true }));
  store.replace('Open', documentOf({ ...character(), id: 'c2' }));
  expect(transport.get()).toMatchObject({ range: [0, 2], timeSeconds: 0, playing: false });
});

function sampled(id: string, frameSeconds: number) {
  const frames = {
    ...takeOfValues(id, [], [0, 10 * frameSeconds]),
    samples: {
      frameCount: 11,
      frameSeconds,
      startSeconds: 0,
      firstChannel: 0,
      values: new Float64Array(11),
      scales: Float64Array.of(1),
      interpolation: 'linear' as const,
    },
  };
  return character({ id, takes: [frames], shownTake: 0 });
}

it('takes the frame rate of takes opened into an empty page, or replacing everything', () => {
  const { store, transport } = following();
  const rate = () => transport.get().framesPerSecond;
  store.replace('Open', documentOf(sampled('c1', 0.0083333), sampled('c2', 1 / 120)));
  expect(rate()).toBe(120);
  store.replace('Open', documentOf(sampled('c3', 0.01)));
  expect(rate()).toBe(100);
});

it('keeps the frame rate when takes are added, differ in rate, or are keyed', () => {
  const { store, transport } = following();
  const rate = () => transport.get().framesPerSecond;
  store.replace('Open', documentOf(walking));
  expect(rate()).toBe(30);
  store.replace('Open', documentOf(walking, sampled('c2', 0.01)));
  expect(rate()).toBe(30);
  store.replace('Open', documentOf(sampled('c3', 0.01), sampled('c4', 0.02)));
  expect(rate()).toBe(30);
});

it('keeps a frame rate that was set by hand', () => {
  const { store, transport } = following();
  store.replace('Open', documentOf(sampled('c1', 0.01)));
  transport.update((now) => ({ ...now, framesPerSecond: 24 }));
  store.apply(setTakeRange, { characterId: 'c1', range: [0, 0.05] });
  expect(transport.get().framesPerSecond).toBe(24);
});

it('starts where a character’s take does, even if retargeted', () => {
  const later = { ...walking, timeOffsetSeconds: -1.5 };
  expect(startSeconds(later)).toBe(2.5);
  expect(startSeconds({ ...character(), shownTake: -1, timeOffsetSeconds: 0.5 })).toBe(-0.5);
  expect(rangeOfTakes(documentOf(later))?.[0]).toBe(startSeconds(later));
});
