import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ownHeights, sameHeight, sameUnit } from '../../src/edit/commands/heights.ts';
import { extentOf } from '../../src/edit/place-beside.ts';
import { spreadOfHeights } from '../../src/edit/same-height.ts';
import { capturedContent } from '../../src/files/captured.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { type Character, DEFAULT_PLACEMENT, type Document, EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { character, documentOf, joint, skelFile } from '../helpers/builders.ts';
import { expectEdit } from '../helpers/expect-edit.ts';
import { personSkeleton, takeOfRoots } from '../helpers/mocap.ts';

const NO_BOX = { min: [0, 0, 0], max: [0, 0, 0] } as const;

/** A post of that height, with an arm to the side. */
const post = (id: string, height: number, more: Partial<Character> = {}) => {
  const at = (x: number, y: number) => ({ offset: [x * height, y * height, 0] as const, box: NO_BOX });
  const joints = [joint(-1, at(0, 0)), joint(0, at(0, 1)), joint(1, at(0.4, -0.2))];
  return character({ id, name: id, skeleton: { name: id, joints }, ...more });
};

/** Sizes of posts as dropped together, and which of them is the reference. */
const dropped = fc
  .array(fc.double({ min: 0.02, max: 60, noNaN: true }), { minLength: 2, maxLength: 12 })
  .chain((heights) => fc.record({ heights: fc.constant(heights), at: fc.nat(heights.length - 1) }))
  .map(({ heights, at }) => ({
    heights,
    at,
    document: openFiles(
      EMPTY_DOCUMENT,
      heights.map((height, i) => {
        const { skeleton } = post(`p${String(i).padStart(2, '0')}`, height);
        return skelFile(`${skeleton?.name}.skel`, ...(skeleton ? [skeleton] : []));
      }),
    ).document,
  }));

const idsOf = ({ characters }: Document) => ({ characterIds: characters.map((c) => c.id) });
const same = (document: Document, like: string) => ({ ...idsOf(document), like });

/** Along x and z as placed, with its height. */
function shown({ characters }: Document) {
  return characters.map((c) => {
    const { min, max, height } = extentOf(c);
    const [{ position, scale }] = c.placements;
    return {
      left: position[0] + scale * min,
      right: position[0] + scale * max,
      z: position[2],
      height: scale * height,
    };
  });
}

describe('same height', () => {
  it('same height gives all characters the height of one of them, which keeps its own', () => {
    fc.assert(
      fc.property(dropped, ({ document, heights, at }) => {
        const after = expectEdit(document, sameHeight, same(document, document.characters[at].id));
        for (const { height } of shown(after)) expect(Math.abs(height / heights[at] - 1)).toBeLessThan(1e-9);
        expect(after.characters[at].placements[0].scale).toBe(1);
      }),
      { numRuns: 15 },
    );
  });

  it('same unit scales by powers of ten alone, to within √10 of the height of one of them, which keeps its own', () => {
    fc.assert(
      fc.property(dropped, ({ document, heights, at }) => {
        const after = expectEdit(document, sameUnit, same(document, document.characters[at].id));
        expect(after.characters[at].placements[0].scale).toBe(1);
        for (const [i, { height }] of shown(after).entries()) {
          const tens = Math.log10(after.characters[i].placements[0].scale);
          expect(Math.abs(tens - Math.round(tens))).toBeLessThan(1e-9);
          expect(Math.abs(Math.log10(height / heights[at]))).toBeLessThan(0.5 + 1e-9);
        }
        expect(sameUnit.run(after, same(document, document.characters[at].id))).toBe(after);
      }),
      { numRuns: 15 },
    );
  });

  it('same height applied twice is the same as once', () => {
    fc.assert(
      fc.property(dropped, ({ document, at }) => {
        const args = same(document, document.characters[at].id);
        const once = sameHeight.run(document, args);
        expect(sameHeight.run(once, args)).toBe(once);
      }),
      { numRuns: 15 },
    );
  });

  it('same height leaves no two characters over each other', () => {
    fc.assert(
      fc.property(dropped, ({ document, at }) => {
        const after = shown(sameHeight.run(document, same(document, document.characters[at].id)));
        after.forEach((a, i) => {
          for (const b of after.slice(0, i)) {
            const isApart = a.left > b.right || b.left > a.right || Math.abs(a.z - b.z) > a.height;
            expect(isApart).toBe(true);
          }
        });
      }),
      { numRuns: 15 },
    );
  });

  it('same height leaves gaps by the sizes as placed: all of a row fit within a few of their heights', () => {
    fc.assert(
      fc.property(dropped, ({ document, at, heights }) => {
        const after = shown(sameHeight.run(document, same(document, document.characters[at].id)));
        const [left, right] = [Math.min(...after.map((c) => c.left)), Math.max(...after.map((c) => c.right))];
        // A post is 0.4 of its height wide; the gap is a quarter of that.
        expect(right - left).toBeLessThan(8 * 0.51 * heights[at]);
      }),
      { numRuns: 15 },
    );
  });

  it('own heights is the way back, to where the characters were placed when they were opened', () => {
    fc.assert(
      fc.property(dropped, ({ document, at }) => {
        const scaled = sameHeight.run(document, same(document, document.characters[at].id));
        expect(ownHeights.run(scaled, idsOf(document))).toEqual(document);
        expect(ownHeights.run(document, idsOf(document))).toBe(document);
      }),
      { numRuns: 15 },
    );
  });

  it('further instances keep their position and size relative to the first', () => {
    const aside = { ...DEFAULT_PLACEMENT, position: [1, 0, 0.5] as const, scale: 2 };
    const document = documentOf(post('a', 2), post('b', 0.5, { placements: [DEFAULT_PLACEMENT, aside] }));
    const after = expectEdit(document, sameHeight, same(document, 'a'));
    const [first, second] = after.characters[1].placements;
    expect(first.scale).toBe(4);
    expect(second.scale).toBe(8);
    expect(second.position.map((v, k) => v - first.position[k])).toEqual([4, 0, 2]);
  });

  it('characters of one file keep their relative sizes', () => {
    const [tall, small] = [1, 0.5].map((scale, i) => {
      const { joints } = personSkeleton();
      const scaled = joints.map((j) => ({ ...j, offset: j.offset.map((v) => scale * v) as [number, number, number] }));
      const skeleton = { name: `figure${i}`, joints: scaled };
      return { skeleton, take: { ...takeOfRoots(skeleton, [[0, 85 * scale, 0]]), name: skeleton.name } };
    });
    const source = { name: 'pair.bvh', path: 'pair.bvh', bytes: 1 };
    const capture = { ...capturedContent([tall, small], source.name).value, source };
    const { skeleton } = post('post', 40);
    const files = [capture, skelFile('post.skel', ...(skeleton ? [skeleton] : []))];
    const { document } = openFiles(EMPTY_DOCUMENT, files);
    const reference = document.characters.find((c) => c.name === 'post');
    const after = sameHeight.run(document, same(document, reference?.id ?? ''));
    const heights = shown(after).map(({ height }) => height);
    expect(heights[0]).toBeCloseTo(40, 6);
    expect(heights[1]).toBeCloseTo(20, 6);
    expect(heights[2]).toBeCloseTo(40, 9);
  });

  it('a character without a height keeps its scale, and can’t be the measure of others', () => {
    const point = character({
      id: 'point',
      name: 'point',
      skeleton: { name: 'point', joints: [joint(-1, { box: NO_BOX })] },
    });
    const document = documentOf(post('a', 2), point);
    expect(sameHeight.run(document, same(document, 'a')).characters[1].placements[0].scale).toBe(1);
    expect(() => sameHeight.run(document, same(document, 'point'))).toThrow('point has no height. Select a character');
  });

  it('the height of a character without a skin is that of its boxes', () => {
    const box = { min: [-1, 0, -1], max: [1, 3, 1] } as const;
    const tower = character({ id: 'tower', name: 'tower', skeleton: { name: 'tower', joints: [joint(-1, { box })] } });
    const document = documentOf(post('a', 6), tower);
    expect(sameHeight.run(document, same(document, 'a')).characters[1].placements[0].scale).toBe(2);
  });

  it('the spread of heights is that of the characters as placed', () => {
    const large = post('large', 3, { placements: [{ ...DEFAULT_PLACEMENT, scale: 2 }] });
    expect(spreadOfHeights([post('a', 0.5), large])).toEqual([0.5, 6]);
    expect(spreadOfHeights([])).toBeUndefined();
  });
});
