import { describe, expect, it } from 'vitest';
import type { FileContent } from '../../src/model/files.ts';
import { FORMAT_KINDS, KINDS, READABLE_EXTENSIONS } from '../../src/project/kinds.ts';
import { formatOf } from '../../src/project/open/readers.ts';
import { writeFile } from '../../src/project/save/writers.ts';
import { clip, morph, skin } from '../helpers/builders.ts';

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

  it('the list of formats has a writer for each', () => {
    const contents: readonly FileContent[] = [
      { kind: 'skel', skeletons: [] },
      { kind: 'skin', skin: skin() },
      { kind: 'morph', morph: morph('smile') },
      { kind: 'anim', clip: clip('walk', [1]) },
      { kind: 'rig', rig: { name: 'x', morphs: [] } },
      { kind: 'bvh', figures: [] },
      { kind: 'pose', poses: [] },
    ];
    expect(new Set(contents.map((c) => c.kind))).toEqual(new Set(FORMAT_KINDS.map((kind) => KINDS[kind].content)));
    for (const content of contents) expect(writeFile(content, `x.${content.kind}`)?.diagnostics).toEqual([]);
  });

  it('the list of formats writes no picture', () => {
    const texture = { name: 'a.png', mime: 'image/png', bytes: new Uint8Array(0) };
    expect(writeFile({ kind: 'texture', texture }, 'a.png')).toBeUndefined();
  });
});
