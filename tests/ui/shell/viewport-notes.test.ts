import { describe, expect, it } from 'vitest';
import { EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { DEFAULT_DISPLAY } from '../../../src/model/session.ts';
import { oneSurface } from '../../../src/model/skin.ts';
import { whatIsMissing, withoutWeights } from '../../../src/ui/shell/viewport-pane.ts';
import { character, skeleton, take } from '../builders.ts';

describe('the note over the viewport', () => {
  it('asks for the skeleton of an animation that stands alone', () => {
    const alone = { ...EMPTY_DOCUMENT, characters: [character({ takes: [take([0, 1])] })] };
    expect(whatIsMissing(alone, {}, DEFAULT_DISPLAY)).toBe('wasp has only an animation. Drop its .skel file.');
    const whole = {
      ...EMPTY_DOCUMENT,
      characters: [character({ takes: [take([0, 1])], skeleton: skeleton(['hips', -1]) })],
    };
    expect(whatIsMissing(whole, {}, DEFAULT_DISPLAY)).toBe('');
  });

  it('says nothing of an empty page', () => {
    expect(whatIsMissing(EMPTY_DOCUMENT, {}, { ...DEFAULT_DISPLAY, skin: 'heat' })).toBe('');
  });
});

describe('a skin without weights', () => {
  const triangles = new Uint32Array(3);
  const bare = { name: 'sleeve', positions: new Float64Array(9), triangles, surfaces: oneSurface(triangles) };
  const skin = { ...bare, bindings: new Float64Array(0) };
  const attachments = { start: new Uint32Array(4), joints: new Uint32Array(0), weights: new Float64Array(0) };
  const bones = skeleton(['hips', -1], ['leg', 0]);
  const first = character({ skeleton: bones, skins: [skin] });
  const second = character({ id: 'c2', skeleton: bones, skins: [{ ...skin, attachments }, skin], shownSkin: 1 });
  const found = (characters: readonly ReturnType<typeof character>[], characterId?: string) =>
    withoutWeights({ ...EMPTY_DOCUMENT, characters }, characterId === undefined ? {} : { characterId })?.id;

  it('a skin without weights is pointed out, of the character that is selected first', () => {
    expect(found([first, second])).toBe('c1');
    expect(found([first, second], 'c2')).toBe('c2');
  });

  it('a skin without weights is as it should be where there are no joints to follow, and is none where it is not seen', () => {
    expect(found([{ ...second, shownSkin: 0 }])).toBeUndefined();
    expect(found([{ ...first, isHidden: true }])).toBeUndefined();
    expect(found([character({ skins: [skin] })])).toBeUndefined();
    expect(found([{ ...first, skeleton: skeleton(['hips', -1]) }])).toBeUndefined();
  });
});
