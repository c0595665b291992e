import { describe, expect, it } from 'vitest';
import { extentOf } from '../../src/edit/place-beside.ts';
import { capturedContent } from '../../src/files/captured.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { type Document, EMPTY_DOCUMENT } from '../../src/model/document.ts';
import type { ParsedFile } from '../../src/model/files.ts';
import { personSkeleton, takeOfRoots } from '../helpers/mocap.ts';

type Point = readonly [number, number, number];

/** A capture of so many characters, each with its root somewhere. */
function bvh(name: string, ...roots: readonly Point[]): ParsedFile {
  const captures = roots.map((root, i) => {
    const skeleton = { ...personSkeleton(), name: i ? `${name}${i}` : name };
    return { skeleton, take: { ...takeOfRoots(skeleton, [root]), name: skeleton.name } };
  });
  const source = { name: `${name}.bvh`, path: `${name}.bvh`, bytes: 1 };
  return { ...capturedContent(captures, source.name).value, source };
}

const open = (files: readonly ParsedFile[], document: Document = EMPTY_DOCUMENT) => openFiles(document, files).document;

/** Positions of the roots on the ground, x and z. */
function standing({ characters }: Document): [number, number][] {
  return characters.map((character) => {
    const { min, max, depth } = extentOf(character);
    const [{ position }] = character.placements;
    return [position[0] + (min + max) / 2, position[2] + depth];
  });
}

/** Centimetres, anywhere in the file's own space. */
const anywhere = (i: number): Point => [((i * 137) % 900) - 400, 85, ((i * 71) % 700) - 300];
const names = (count: number) => Array.from({ length: count }, (_, i) => `take${String(i).padStart(2, '0')}`);
const takes = (count: number) => names(count).map((name, i) => bvh(name, anywhere(i)));

describe('captures that are dropped at once', () => {
  it('captures that are dropped at once are placed in rows of eight', () => {
    const at = standing(open(takes(50)));
    for (let i = 0; i < 50; i++) expect(at[i][1]).toBeCloseTo(at[i - (i % 8)][1], 2);
    const rows = new Set(at.map(([, z]) => z.toFixed(1)));
    expect(rows.size).toBe(7);
    for (let i = 0; i < 50; i++) expect(at[i][0]).toBeCloseTo(at[i % 8][0], 1);
    for (let i = 1; i < 8; i++) expect(at[i][0] - at[i - 1][0]).toBeGreaterThan(0.2);
  });

  it('leave room to walk between the rows, by their size', () => {
    const [[, first], , , , , , , , [, second]] = standing(open(takes(9)));
    // From the feet to the head's joint, 0.8 of 1.7 m, and half as much again.
    expect(second - first).toBeCloseTo(1.5 * 0.8 * 1.7, 2);
  });

  it('count as one if they are in one file, and keep their relative positions', () => {
    const pair = bvh('pair', [0, 85, 0], [60, 85, 400]);
    const document = open([pair, ...takes(8)]);
    const { characters } = document;
    expect(characters[1].placements).toEqual(characters[0].placements);
    const at = standing(document);
    // Seven beside the pair, and the last one before it; the pair's second character, 4 m away, is no row.
    for (let i = 2; i < 9; i++) expect(at[i][1]).toBeCloseTo(at[0][1], 2);
    expect(at[9][1]).toBeGreaterThan(at[0][1] + 2);
    expect(at[2][0]).toBeGreaterThan(at[1][0] + 0.2);
  });

  it('captures dropped at once are placed as if they had been dropped one after the other', () => {
    let document = EMPTY_DOCUMENT;
    for (const file of takes(20)) document = open([file], document);
    expect(standing(document)).toEqual(standing(open(takes(20))));
  });
});
