import { describe, expect, it } from 'vitest';
import type { FileContent } from '../../src/model/files.ts';
import { type Joint, UNLIMITED } from '../../src/model/skeleton.ts';
import { FORMAT_KINDS, type FormatKind, KINDS, READABLE_EXTENSIONS } from '../../src/project/kinds.ts';
import { formatOf } from '../../src/project/open/readers.ts';
import { writeFile } from '../../src/project/save/writers.ts';
import { read } from '../formats/read-in-pieces.ts';
import { clip, joint, morph, skeleton, skin } from '../helpers/builders.ts';
import { bvhFigure, bvhJoint } from '../helpers/bvh.ts';

const HINGE: Joint = {
  ...joint(-1, { name: '', offset: [0, 0, 0] }),
  motion: { kind: 'hinge', axis: [0, 0, 1] },
  limits: [UNLIMITED],
  pose: [0],
  length: 1,
};

/** Something for each kind to hold. */
const CONTENTS: Readonly<Record<FormatKind, FileContent>> = {
  skel: { kind: 'skel', skeletons: [skeleton(2)] },
  axskel: { kind: 'skel', skeletons: [{ name: 'x', joints: [HINGE], form: 'axis-angle' }] },
  skin: { kind: 'skin', skin: skin() },
  morph: { kind: 'morph', morph: morph('x') },
  anim: { kind: 'anim', clip: clip('x', [1]) },
  rig: { kind: 'rig', rig: { name: 'x', skeleton: 'x.skel', morphs: [] } },
  bvh: {
    kind: 'bvh',
    figures: [bvhFigure({ name: 'x', joints: [bvhJoint(-1, ['rx'], { name: 'hips' })] }, [[0], [5]])],
  },
  pose: { kind: 'pose', poses: [{ name: 'x', joints: [], weights: [] }] },
};

describe('the list of kinds of files', () => {
  it('finds a format by the end of a name, in any case', () => {
    expect(formatOf('wasp.skel')?.kind).toBe('skel');
    expect(formatOf('a/b.c/WASP.Walk.ANIM')?.kind).toBe('anim');
    expect(formatOf('skin')).toBeUndefined();
    expect(formatOf('head.bmp')).toBeUndefined();
  });

  it('the list of formats has each extension once', () => {
    expect(new Set(READABLE_EXTENSIONS).size).toBe(READABLE_EXTENSIONS.length);
  });

  it.each(FORMAT_KINDS)('what is written as %s is read, and written the same again', (kind) => {
    const name = `x.${KINDS[kind].extensions[0]}`;
    const written = writeFile(CONTENTS[kind], name);
    expect(written?.diagnostics).toEqual([]);
    const { value, diagnostics } = read(name, written?.text ?? '');
    expect(diagnostics).toEqual([]);
    expect(value?.kind).toBe(KINDS[kind].content);
    expect(value && writeFile(value, name)?.text).toBe(written?.text);
  });

  it('the list of formats writes no picture', () => {
    const texture = { name: 'a.png', mime: 'image/png', bytes: new Uint8Array(0) };
    expect(writeFile({ kind: 'texture', texture }, 'a.png')).toBeUndefined();
  });
});
