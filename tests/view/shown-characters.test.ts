import { Group } from 'three';
import { describe, expect, it } from 'vitest';
import { DEFAULT_DISPLAY } from '../../src/model/session.ts';
import { CharacterView } from '../../src/view/character-view.ts';
import { ShownCharacters } from '../../src/view/shown-characters.ts';
import { character, documentOf, joint, skin } from '../helpers/builders.ts';
import { captured, figure, take } from '../helpers/mocap.ts';

const skeleton = figure();
const space = { up: 'y', unit: 'centimetres', lift: 0 } as const;
const near = captured(skeleton, take(skeleton, [[0, 85, 0]]), { id: 'near', space });
const far = captured(skeleton, take(skeleton, [[1000, 85, 0]]), { id: 'far', space });

function shown(...characters: (typeof near)[]): ShownCharacters {
  const all = new ShownCharacters(
    new Group(),
    () => new CharacterView(),
    () => {},
  );
  all.show(documentOf(...characters), DEFAULT_DISPLAY, {}, 0, true);
  all.place(false);
  return all;
}

describe('the characters in the picture', () => {
  it('the characters in the picture are framed where they stand, in metres', () => {
    const { content } = shown(near, far);
    expect(content.max.y).toBeCloseTo(1.7, 6);
    expect(content.min.y).toBeCloseTo(0, 6);
    expect(content.max.x).toBeCloseTo(10.102, 6);
  });

  it('hidden characters are neither drawn nor framed, and posed all the same', () => {
    const all = shown(near, { ...far, isHidden: true });
    expect(all.posedSkeletons(new Map()).map((p) => p.characterId)).toEqual(['near']);
    expect(all.content.max.x).toBeLessThan(1);
    expect(all.seen('far')).toBeUndefined();
    expect(all.get('far')?.view.object.visible).toBe(false);
    expect(all.get('far')?.view.dofs[0]).toBe(1000);
    all.show(documentOf(near, far), DEFAULT_DISPLAY, {}, 0, false);
    expect(all.posedSkeletons(new Map())).toHaveLength(2);
  });

  it('stand on the spot in place', () => {
    const all = shown(far);
    all.show(documentOf(far), { ...DEFAULT_DISPLAY, inPlace: true }, {}, 0, true);
    all.place(true);
    expect(all.content.max.x).toBeCloseTo(0.102, 6);
    expect(all.content.max.y).toBeCloseTo(1.7, 6);
  });

  it('stand still in place while they are dragged about, and on the spot again after it', () => {
    const display = { ...DEFAULT_DISPLAY, inPlace: true };
    const all = shown(far);
    all.show(documentOf(far), display, {}, 0, true);
    const view = all.get('far')?.view;
    view?.freezeRootMotion(true);
    const dragged = captured(skeleton, take(skeleton, [[1200, 85, 0]]), { id: 'far', space });
    all.show(documentOf(dragged), display, {}, 0, false);
    all.place(true);
    expect(all.content.max.x).toBeCloseTo(2.102, 6);
    expect(all.get('far')?.placements[12]).toBeCloseTo(-10, 6);
    view?.freezeRootMotion(false);
    all.place(true);
    expect(all.content.max.x).toBeCloseTo(0.102, 6);
    expect(all.get('far')?.placements[12]).toBeCloseTo(-12, 6);
  });

  it('a look overrides the display for one character: its skin, its bones, and what its heat map shows', () => {
    const dressed = (id: string) =>
      character({ id, skeleton: { name: 'one', joints: [joint(-1)] }, skins: [skin(id, 0)] });
    const all = new ShownCharacters(
      new Group(),
      () => new CharacterView(),
      () => {},
    );
    const both = documentOf(dressed('near'), dressed('far'));
    const heat = Float32Array.of(0.25);
    const look = { characterId: 'far', skin: 'heat', bones: true, heat } as const;
    const meshOf = (id: string) => all.get(id)?.view.skinnedMeshes[0];
    all.show(both, DEFAULT_DISPLAY, {}, 0, true, look);
    expect(['near', 'far'].map((id) => meshOf(id)?.material.name)).toEqual(['skin solid', 'skin heat']);
    const values = () => meshOf('far')?.geometry.getAttribute('influence').array[0];
    expect(values()).toBe(0.25);
    expect(all.posedSkeletons(new Map(), look).map(({ withBones }) => withBones)).toEqual([false, true]);

    all.show(both, { ...DEFAULT_DISPLAY, skin: 'heat' }, {}, 0, true);
    expect(['near', 'far'].map((id) => meshOf(id)?.material.name)).toEqual(['skin heat', 'skin heat']);
    expect(values()).toBe(0);
    expect(all.posedSkeletons(new Map()).some(({ withBones }) => withBones)).toBe(false);
  });
});
