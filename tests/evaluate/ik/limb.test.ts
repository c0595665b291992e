import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type Bending, bendingOf, isLongerThanLimb, limbOf, union } from '../../../src/evaluate/ik/limb.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { conformance, describeShared, sharedBytes } from '../../helpers/shared.ts';
import { anySkeleton } from './any-problem.ts';

describeShared('limbs of real skeletons', () => {
  interface Case {
    readonly skel: string;
    readonly joint: number;
    readonly reach: Bending;
  }

  it('bend what the reference says, joint by joint', () => {
    const { reach } = conformance<{ reach: readonly Case[] }>('craft.json');
    const files = new Map(reach.map(({ skel }) => [skel, readSkel(sharedBytes(skel), skel).value?.[0]]));
    const found = reach.map((one) => {
      const skeleton = files.get(one.skel);
      return { ...one, reach: skeleton && limbOf(skeleton, one.joint) };
    });
    expect(found).toEqual(reach);
    expect(reach.length).toBe(128);
  });
});

describe('limbs of any skeleton', () => {
  it('are ways up from the joint itself, and the body for the root', () => {
    fc.assert(
      fc.property(anySkeleton(false), fc.nat(), ({ name, joints }, n) => {
        const joint = n % joints.length;
        const limb = limbOf({ name, joints }, joint);
        if (joint === 0) expect(limb).toBe('body');
        if (limb === 'body') return;
        expect(limb.at(-1)).toBe(joint);
        for (let i = 1; i < limb.length; i++) expect(joints[limb[i]].parent).toBe(limb[i - 1]);
      }),
    );
  });

  it('are the chain up to a chosen joint, if that is above', () => {
    fc.assert(
      fc.property(anySkeleton(false), fc.nat(), fc.nat(), (skeleton, n, m) => {
        const [joint, top] = [n, m].map((i) => i % skeleton.joints.length);
        const chain = bendingOf(skeleton, joint, { top });
        const way = [joint];
        while (way[0] !== top && skeleton.joints[way[0]].parent >= 0) way.unshift(skeleton.joints[way[0]].parent);
        expect(chain).toEqual(way[0] === top ? way : limbOf(skeleton, joint));
      }),
    );
  });

  it('together are each joint once, or the body', () => {
    expect(union([[3, 4], [1], [1, 3]])).toEqual([1, 3, 4]);
    expect(union([[3, 4], 'body'])).toBe('body');
  });
});

it('a head is much longer than its neck, but no hand or forearm than what moves it, and what bends alone doesn’t count', () => {
  const text = `balljoint chest {
    balljoint neck { offset 0 0.5 0 boxmin 0 0 0 boxmax 0 0 0
      balljoint head { offset 0 0.1 0
        balljoint ear { offset 0 0.3 0 }
      }
    }
    balljoint arm { offset 0.2 0.4 0
      balljoint fore { offset 0.3 0 0
        balljoint hand { offset 0.3 0 0
          balljoint finger { offset 0.1 0 0 }
        }
      }
    }
    balljoint leg { offset 0 -0.2 0
      balljoint foot { offset 0 -0.5 0 }
    }
  }`;
  const skeleton = readSkel(new TextEncoder().encode(text), 'body.skel').value?.[0];
  if (!skeleton) throw new Error('It is a skeleton.');
  const longer = skeleton.joints.flatMap(({ name }, j) => (isLongerThanLimb(skeleton, j) ? [name] : []));
  expect(longer).toEqual(['head']);
});
