import { Color, Group, InstancedMesh, MeshStandardMaterial } from 'three';
import { describe, expect, it } from 'vitest';
import { DEFAULT_DISPLAY } from '../../src/model/session.ts';
import { CharacterView } from '../../src/view/character-view.ts';
import { ShownCharacters } from '../../src/view/shown-characters.ts';
import { SkeletonDrawing } from '../../src/view/skeleton/skeleton-drawing.ts';
import { DrawnSkins } from '../../src/view/skin/drawn-skins.ts';
import { STAGE_THEMES, type Tints } from '../../src/view/theme.ts';
import { character, documentOf, skin } from '../helpers/builders.ts';
import { captured, personSkeleton, takeOfRoots } from '../helpers/mocap.ts';

const skeleton = personSkeleton();
const motion = takeOfRoots(skeleton, [[0, 85, 0]]);
const document = documentOf(captured(skeleton, motion, { id: 'a' }), captured(skeleton, motion, { id: 'b' }));

/** Colours of the joints, by instance. */
function painted(tints: Tints): Color[] {
  const characters = new ShownCharacters(
    new Group(),
    () => new CharacterView(new DrawnSkins()),
    () => {},
  );
  characters.show(document, DEFAULT_DISPLAY, {}, 0, true);
  characters.place(false);
  const drawing = new SkeletonDrawing();
  drawing.show(characters.posedSkeletons(tints), DEFAULT_DISPLAY, {}, STAGE_THEMES.dark);
  drawing.fill();
  const balls = drawing.object.children.find(
    (mesh): mesh is InstancedMesh => mesh instanceof InstancedMesh && mesh.visible && mesh.count > 0,
  );
  return Array.from({ length: balls?.count ?? 0 }, (_, i) => {
    const colour = new Color();
    balls?.getColorAt(i, colour);
    return colour;
  });
}

const like = (css: string) => new Color(css).getHexString();

describe('two characters that are compared', () => {
  it('two characters that are compared have their joints in two colours, and others in the joints’ own', () => {
    const { bone, comparedFirst, comparedSecond } = STAGE_THEMES.dark;
    const both = painted(
      new Map([
        ['a', 'comparedFirst'],
        ['b', 'comparedSecond'],
      ]),
    ).map((c) => c.getHexString());
    const half = both.length / 2;
    expect(new Set(both.slice(0, half))).toEqual(new Set([like(comparedFirst)]));
    expect(new Set(both.slice(half))).toEqual(new Set([like(comparedSecond)]));
    expect(new Set(painted(new Map()).map((c) => c.getHexString()))).toEqual(new Set([like(bone)]));
  });

  it('two characters that are compared have their skins dyed, and as they were afterwards', () => {
    const view = new CharacterView(new DrawnSkins());
    view.setTint('comparedFirst');
    view.show(character({ skins: [skin()] }), { ...DEFAULT_DISPLAY, skin: 'solid' }, undefined);
    const colour = () => {
      const material = view.skinnedMeshes[0]?.material;
      return material instanceof MeshStandardMaterial ? material.color.getHexString() : undefined;
    };
    const dyed = colour();
    view.setTint('comparedSecond');
    expect(colour()).not.toBe(dyed);
    view.setTint(undefined);
    const own = colour();
    expect(own).toBeDefined();
    expect(own).not.toBe(dyed);
    view.setTint('comparedFirst');
    expect(colour()).toBe(dyed);
  });
});
