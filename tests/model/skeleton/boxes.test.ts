import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { areBoxesOversized } from '../../../src/model/skeleton/boxes.ts';
import { DEFAULT_BOX, type Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';

/** A chain of joints one unit apart, with cubes of that size. */
const chain = (size: number): Skeleton => {
  const box = { min: [0, 0, 0], max: [size, size, size] } as const;
  return { name: 'chain', joints: Array.from({ length: 20 }, (_, i) => joint(i - 1, { box })) };
};

describe('boxes far larger than the bones', () => {
  it('boxes are far larger than the bones at ten times their length, not at twice', () => {
    expect(areBoxesOversized(chain(10))).toBe(true);
    expect(areBoxesOversized(chain(2))).toBe(false);
  });

  it('boxes of thousands of joints in one place hide the skeleton, and those side by side do not', () => {
    const star = (rays: number, length: number): Skeleton => ({
      name: 'star',
      joints: [
        joint(-1),
        ...Array.from({ length: rays }, (_, r) =>
          joint(0, { offset: [length * Math.sin(r), 0, length * Math.cos(r)] }),
        ),
      ],
    });
    expect(areBoxesOversized(star(20_000, 1))).toBe(true);
    expect(areBoxesOversized(star(20_000, 5))).toBe(false);
    expect(areBoxesOversized(star(900, 1))).toBe(false);
  });

  it('a skeleton without boxes has none that are too large', () => {
    const joints = chain(1).joints.map((one) => ({ ...one, length: 1, box: DEFAULT_BOX }));
    expect(areBoxesOversized({ name: 'bare', joints })).toBe(false);
  });

  it('a few joints keep their boxes, whatever their size', () => {
    expect(areBoxesOversized({ name: 'few', joints: chain(100).joints.slice(0, 3) })).toBe(false);
  });

  it.each(['walker', 'crawler', 'joints', 'cube'])('the example %s keeps its boxes', (name) => {
    const text = readFileSync(new URL(`../../../public/samples/${name}.skel`, import.meta.url), 'utf8');
    for (const skeleton of readSkel(text, `${name}.skel`).value ?? []) expect(areBoxesOversized(skeleton)).toBe(false);
  });
});

describeShared('characters with boxes of their own', () => {
  it.each(['dragon', 'test', 'tube', 'wasp'])('%s keeps its boxes', (name) => {
    const { value = [] } = readSkel(sharedBytes(`data/cse169/${name}.skel`), `${name}.skel`);
    expect(value.map(areBoxesOversized)).toEqual(value.map(() => false));
  });
});
