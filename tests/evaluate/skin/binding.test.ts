import { describe, expect, it } from 'vitest';
import { checkMorph, checkSkin, checkTake } from '../../../src/evaluate/skin/binding.ts';
import { morph, skeleton, skin, takeOfValues } from '../../helpers/builders.ts';

const channels = (n: number) => takeOfValues('walk', new Array<number>(n).fill(0));

describe('a skin and its skeleton', () => {
  it('a skin and its skeleton fit when every joint that is used exists', () => {
    expect(checkSkin(skin('hero', 1), skeleton(2), 'hero.skin')).toEqual([]);
    const { attachments: _none, ...rigid } = skin();
    expect(checkSkin({ ...rigid, bindings: new Float64Array(0) }, skeleton(1), 'hero.skin')).toEqual([]);
  });

  it('fewer bindings than joints are said, with both counts', () => {
    expect(checkSkin(skin('hero', 1), skeleton(5), 'hero.skin')).toMatchObject([
      {
        severity: 'info',
        code: 'bindings-fewer',
        message: 'The skin has 2 bindings, but "hero" has 5 joints.',
        assumed: 'joints from 2 on move no vertex',
      },
    ]);
  });

  it('a skin and its skeleton do not fit when a joint is missing: the first vertex that needs one is named', () => {
    const attachments = {
      start: Uint32Array.of(0, 1, 1, 3),
      joints: Uint32Array.of(0, 1, 5),
      weights: Float64Array.of(1, 0.5, 0.5),
    };
    expect(checkSkin(skin('hero', 5, { attachments }), skeleton(2), 'hero.skin')).toEqual([
      {
        severity: 'error',
        code: 'joint-missing',
        message: 'Vertex 2 is attached to joint 5, but "hero" has 2 joints (0 to 1).',
        file: 'hero.skin',
        line: 0,
        column: 0,
      },
    ]);
  });

  it('a skin and its skeleton fit with a warning when only bindings are too many', () => {
    const bindings = new Float64Array(48);
    expect(checkSkin(skin('hero', 0, { bindings }), skeleton(1), 'hero.skin')).toMatchObject([
      { severity: 'warning', code: 'bindings-more', message: 'The skin has 3 bindings, but "hero" has 1 joint.' },
    ]);
  });
});

describe('a morph and its skin', () => {
  it('a morph and its skin fit when every vertex exists', () => {
    expect(checkMorph(morph('smile', 2), skin(), 'smile.morph')).toEqual([]);
  });

  it('a morph and its skin do not fit when a vertex is missing, be it for its normal only', () => {
    const wrong = {
      severity: 'error',
      code: 'vertex-missing',
      message: 'Row 1 of the positions is for vertex 9, but "hero" has 3 vertices (0 to 2).',
      file: 'smile.morph',
    };
    expect(checkMorph(morph('smile', 9), skin(), 'smile.morph')).toMatchObject([wrong]);
    const swapped = { ...morph('smile', 0), normals: morph('smile', 3).positions };
    expect(checkMorph(swapped, skin(), 'smile.morph')).toMatchObject([
      { message: expect.stringContaining('Row 1 of the normals is for vertex 3') },
    ]);
  });
});

describe('a take and its skeleton', () => {
  it('a take and its skeleton fit with channels for root translation and joints, with or without the morphs', () => {
    expect(checkTake(channels(9), skeleton(2), 0, 'walk.anim')).toEqual([]);
    expect(checkTake(channels(9), skeleton(2), 4, 'walk.anim')).toEqual([]);
    expect(checkTake(channels(13), skeleton(2), 4, 'walk.anim')).toEqual([]);
  });

  it('bring a warning with fewer channels', () => {
    expect(checkTake(channels(3), skeleton(2), 4, 'walk.anim')).toMatchObject([
      {
        severity: 'warning',
        code: 'channels-fewer',
        message: 'The animation has 3 channels, but "hero" needs 9: 3 for the root translation, 6 for its joints.',
      },
    ]);
    expect(checkTake(channels(10), skeleton(2), 2, 'walk.anim')).toMatchObject([
      {
        code: 'channels-fewer',
        message: expect.stringContaining('needs 11: 3 for the root translation, 6 for its joints and 2 for its morphs'),
      },
    ]);
  });

  it('bring a warning with more channels', () => {
    expect(checkTake(channels(12), skeleton(2), 1, 'walk.anim')).toMatchObject([
      { severity: 'warning', code: 'channels-more', assumed: 'the last 2 channels are unused' },
    ]);
  });
});
