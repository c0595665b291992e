import { describe, expect, it } from 'vitest';
import { file, morph, morphFile, skeleton, skelFile, skin, skinFile } from '../../helpers/builders.ts';
import { only, open } from './opening.ts';

describe('files that lay unused', () => {
  const tube = open([skelFile('tube.skel', skeleton(2, 'tube'))]).document;
  const waiting = open([morphFile('head1.morph', morph('head1', 99))], tube);

  it('files that lay unused are reported, and kept', () => {
    expect(waiting.diagnostics).toMatchObject([{ severity: 'info', code: 'file-unused', file: 'head1.morph' }]);
    expect(waiting.document.unused).toHaveLength(1);
    expect(waiting.document.characters).toBe(tube.characters);
  });

  it('don’t get in the way of what has nothing to do with them', () => {
    const { document, diagnostics } = open(
      [skelFile('wasp.skel', skeleton(2, 'wasp')), skinFile('wasp.skin', skin('wasp'))],
      waiting.document,
    );
    expect(document.characters.map((c) => c.name)).toEqual(['tube', 'wasp']);
    expect(diagnostics).toEqual([]);
    expect(document.unused).toHaveLength(1);
  });

  it('files that lay unused keep waiting, silently, if they fit by name but not in content', () => {
    const { document, diagnostics } = open([skinFile('head.skin', skin('head'))], waiting.document, 'c1');
    expect(diagnostics).toEqual([]);
    expect(document.unused).toHaveLength(1);
  });

  it('files that lay unused are still there when the opening example is replaced', () => {
    const sample = { ...tube, isOpeningSample: true };
    const dropped = open([morphFile('head1.morph', morph('head1'))], sample);
    expect(dropped.document.isOpeningSample).toBe(true);
    const { document } = open(
      [skelFile('head.skel', skeleton(1, 'head')), skinFile('head.skin', skin('head'))],
      dropped.document,
    );
    expect(only(document).morphs).toHaveLength(1);
  });

  it('files that lay unused come with a rig that names them', () => {
    const rig = { name: 'Hero', skeleton: 'bones.skel', skin: 'body.skin', morphs: ['head1.morph'] };
    const first = open([morphFile('head1.morph', morph('head1'))]).document;
    const files = [
      skelFile('bones.skel', skeleton()),
      skinFile('body.skin', skin()),
      file('x.rig', { kind: 'rig', rig }),
    ];
    const { document, diagnostics } = open(files, first);
    expect(only(document).morphs).toHaveLength(1);
    expect(diagnostics).toEqual([]);
  });
});
