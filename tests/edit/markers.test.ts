import { describe, expect, it } from 'vitest';
import { addMarkers, changeMarker } from '../../src/edit/commands/markers.ts';
import { bakeRetarget, setRetarget } from '../../src/edit/commands/retarget.ts';
import { cropSamples, resampleSamples, reverseSamples, splitSamples } from '../../src/edit/commands/samples.ts';
import { mirrorTakes, setTakeSpeed } from '../../src/edit/commands/take-edits.ts';
import { cutOutOfTakes, insertIntoTake, joinTakes } from '../../src/edit/commands/take-joins.ts';
import { type Document, shownTake } from '../../src/model/document.ts';
import type { Marker } from '../../src/model/takes/markers.ts';
import { documentOf } from '../helpers/builders.ts';
import { expectEdit } from '../helpers/expect-edit.ts';
import { swing, swinging } from './samples/made.ts';

/** From 0 to 2 s at 60 FPS. */
const MARKERS: readonly Marker[] = [
  { timeSeconds: 0.5, label: 'step' },
  { timeSeconds: 1, endSeconds: 1.5, label: 'stand' },
];
const marked = documentOf(swinging({ ...swing, markers: MARKERS }));
const c1 = { characterId: 'c1' };
const takes = [{ ...c1, take: 0 }];

/** `step 0.5`, `stand 1–1.5`. */
function textOf(document: Document, index = 0): string[] {
  const take = shownTake(document.characters[index]);
  return (take?.markers ?? []).map(({ label, timeSeconds, endSeconds }) => {
    const shown = (seconds: number) => Number(seconds.toFixed(6));
    return `${label} ${shown(timeSeconds)}${endSeconds === undefined ? '' : `–${shown(endSeconds)}`}`;
  });
}

describe('markers of a take', () => {
  it('markers are kept in the order of their times, and refuse a span that ends before its start', () => {
    const added = expectEdit(marked, addMarkers, { ...c1, markers: [{ timeSeconds: 0.2, label: ' two\nlines ' }] });
    expect(textOf(added)).toEqual(['two lines 0.2', 'step 0.5', 'stand 1–1.5']);
    const moved = expectEdit(added, changeMarker, { ...c1, index: 0, marker: { timeSeconds: 3, label: 'end' } });
    expect(textOf(moved)).toEqual(['step 0.5', 'stand 1–1.5', 'end 3']);
    const wrong = { ...c1, markers: [{ timeSeconds: 2, endSeconds: 1, label: '' }] };
    expect(() => addMarkers.run(marked, wrong)).toThrow('before its start');
  });

  it('markers follow what is done to their take: crop, split, reverse, speed, cut, hold', () => {
    expect(textOf(cropSamples.run(marked, { ...c1, from: 0.75, to: 1.25 }))).toEqual(['stand 1–1.25']);
    const split = splitSamples.run(marked, { ...c1, timeSeconds: 1.25 });
    expect(textOf(split)).toEqual(['stand 1.25–1.5']);
    expect(split.characters[0].takes[0].markers?.map(({ label }) => label)).toEqual(['step', 'stand']);
    expect(textOf(reverseSamples.run(marked, c1))).toEqual(['stand 0.5–1', 'step 1.5']);
    expect(textOf(setTakeSpeed.run(marked, { takes, factor: 2 }))).toEqual(['step 0.25', 'stand 0.5–0.75']);
    expect(textOf(resampleSamples.run(marked, { ...c1, framesPerSecond: 30 }))).toEqual(['step 0.5', 'stand 1–1.5']);
    expect(textOf(mirrorTakes.run(marked, { takes }))).toEqual(['step 0.5', 'stand 1–1.5']);
    // 31 frames are gone.
    const cut = cutOutOfTakes.run(marked, { takes, from: 0.25, to: 0.75, overlapSeconds: 0 });
    expect(textOf(cut)).toEqual([`stand ${Number((1 - 31 / 60).toFixed(6))}–${Number((1.5 - 31 / 60).toFixed(6))}`]);
    const held = insertIntoTake.run(marked, { into: takes[0], atSeconds: 1.25, holdSeconds: 0.5 });
    expect(textOf(held)).toEqual(['step 0.5', 'stand 1–2']);
  });

  it('a marker between the frames at which a take is split is in the nearer half', () => {
    const at = (frame: number, label: string): Marker => ({ timeSeconds: frame / 60, label });
    const halves = splitSamples.run(
      documentOf(swinging({ ...swing, markers: [at(59.25, 'early'), at(59.75, 'late')] })),
      { ...c1, timeSeconds: 1 },
    );
    const [before, after] = halves.characters[0].takes.map(({ markers }) => markers);
    expect(before).toEqual([{ timeSeconds: expect.closeTo(59 / 60, 9), label: 'early' }]);
    expect(after).toEqual([{ timeSeconds: 1, label: 'late' }]);
  });

  it('markers of a take that is inserted stay at their frames, of which the first are faded into what precedes', () => {
    const hero = swinging(swing);
    const two = documentOf({ ...hero, takes: [...hero.takes, { ...swing, name: 'again', markers: [MARKERS[0]] }] });
    const args = { into: takes[0], take: { ...c1, take: 1 }, overlapSeconds: 0.25 };
    expect(textOf(insertIntoTake.run(two, { ...args, atSeconds: 1 }))).toEqual(['step 1.25']);
    expect(textOf(insertIntoTake.run(two, { ...args, atSeconds: 0 }))).toEqual(['step 0.5']);
  });

  it('a joined take has the markers of both, and its cross-fade as a span', () => {
    const hero = swinging({ ...swing, markers: MARKERS });
    const two = documentOf({ ...hero, takes: [...hero.takes, { ...swing, name: 'again', markers: [MARKERS[0]] }] });
    const both = { takes: [...takes, { ...c1, take: 1 }] };
    expect(textOf(joinTakes.run(two, { ...both, overlapSeconds: 0 }))).toEqual([
      'step 0.5',
      'stand 1–1.5',
      `step ${Number((121 / 60 + 0.5).toFixed(6))}`,
    ]);
    expect(textOf(joinTakes.run(two, { ...both, overlapSeconds: 0.5 }))[2]).toBe(
      `to again ${Number((91 / 60).toFixed(6))}–2`,
    );
  });

  it('a take that is retargeted and baked has the markers of its source', () => {
    const two = documentOf(
      { ...swinging(), takes: [], shownTake: -1 },
      { ...swinging({ ...swing, markers: MARKERS }), id: 'c2' },
    );
    const driven = setRetarget.run(two, { ...c1, sourceId: 'c2' });
    expect(textOf(bakeRetarget.run(driven, c1))).toEqual(['step 0.5', 'stand 1–1.5']);
  });
});
