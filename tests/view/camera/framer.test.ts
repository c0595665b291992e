import { type Box3, Group, PerspectiveCamera, type Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { type Character, DEFAULT_PLACEMENT } from '../../../src/model/document.ts';
import { DEFAULT_DISPLAY, type Selection } from '../../../src/model/session.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { DEFAULT_SPACE } from '../../../src/model/space.ts';
import { Framer } from '../../../src/view/camera/framer.ts';
import { CharacterView } from '../../../src/view/character-view.ts';
import { PickedCopy } from '../../../src/view/picked-copy.ts';
import { ShownCharacters } from '../../../src/view/shown-characters.ts';
import { DrawnSkins } from '../../../src/view/skin/drawn-skins.ts';
import * as people from '../../evaluate/retarget/people.ts';
import { character, documentOf, skeleton } from '../../helpers/builders.ts';

const STILL = [0, 0] as const;
const COVERED = 90;

/** Two instances, the second ten to the right and twice as large; logs the calls to the camera. */
function framing(change: Partial<Character> = {}) {
  const second = { ...DEFAULT_PLACEMENT, position: [10, 0, 0] as const, scale: 2 };
  const shown = character({ skeleton: skeleton(3), placements: [DEFAULT_PLACEMENT, second], ...change });
  const characters = new ShownCharacters(
    new Group(),
    () => new CharacterView(new DrawnSkins()),
    () => {},
  );
  characters.show(documentOf(shown), DEFAULT_DISPLAY, {}, 0, true);
  characters.place(false);
  const told: string[] = [];
  const spheres: { x: number; radius: number }[] = [];
  const camera = new PerspectiveCamera(30, 1, 0.1, 1000);
  camera.position.set(0, 0, -500);
  const rig = {
    camera,
    frame: (boxes: readonly Box3[], covered: number, smoothly: boolean) =>
      void told.push(
        `${boxes.some((box) => box.max.x > 5) ? 'both' : 'one'}, ${covered} px covered, ${smoothly ? 'smoothly' : 'at once'}`,
      ),
    lookFirst: (_boxes: readonly Box3[], covered: number, facing = 0) =>
      void told.push(`first look at ${Math.round((facing * 180) / Math.PI)}°, ${covered} px covered`),
    partOfHeight: (pixels: number) => pixels / 900,
    frameSphere: ({ x }: Vector3, radius: number) => void spheres.push({ x, radius }),
  };
  const positionOf = (_id: string, placement: number, joint: number, out: Vector3) => {
    out.set(10 * placement, joint, 0);
    return true;
  };
  const picked = new PickedCopy();
  const framer = new Framer(rig, characters, { positionOf }, picked);
  framer.coveredTop = () => COVERED;
  const select = (selection: Selection) => {
    picked.follow(selection);
    framer.frameSelection(selection, STILL, 0);
  };
  return { framer, told, spheres, select, id: shown.id };
}

describe('what is framed', () => {
  it('frames everything, once, with the next frame', () => {
    const { framer, told } = framing();
    framer.frameAll();
    framer.frameAll();
    expect(told).toEqual([]);
    framer.settle(STILL, 0);
    framer.settle(STILL, 0);
    expect(told).toEqual(['both, 90 px covered, smoothly']);
  });

  it('frames the default view, whatever else is requested', () => {
    const { framer, told } = framing();
    framer.lookFirst();
    framer.frameAll();
    framer.settle(STILL, 0);
    expect(told).toEqual(['first look at 0°, 90 px covered']);
  });

  it('first looks at a person from the front, however it was saved and placed, and at others along −z', () => {
    const person = (zUp = false): Skeleton => {
      const { name, joints } = people.person({ motion: () => ({ kind: 'ball', order: 'xyz' }), zUp });
      return { name, joints: joints.map((own) => ({ ...own, role: own.name.replace(' arm', 'UpperArm') })) };
    };
    const about = ({ name, joints }: Skeleton): Skeleton => ({
      name,
      joints: joints.map(({ offset: [x, y, z], ...own }) => ({ ...own, offset: [-x, y, -z] as const })),
    });
    const turned = { ...DEFAULT_PLACEMENT, turn: [0, Math.PI / 2, 0] as const };
    const lookAt = (change: Partial<Character>) => {
      const { framer, told } = framing({ placements: [DEFAULT_PLACEMENT], ...change });
      framer.lookFirst();
      framer.settle(STILL, 0);
      return Number(/at (-?\d+)/.exec(told[0])?.[1]);
    };
    expect(lookAt({ skeleton: person() })).toBe(0);
    expect(Math.abs(lookAt({ skeleton: about(person()) }))).toBe(180);
    expect(lookAt({ skeleton: person(), placements: [turned] })).toBe(90);
    expect(lookAt({ skeleton: person(true), space: { ...DEFAULT_SPACE, up: 'z' } })).toBe(0);
    expect(lookAt({ skeleton: about(people.person()) })).toBe(0);
  });

  it('frames nothing if the camera was moved meanwhile', () => {
    const { framer, told } = framing();
    framer.frameAll();
    framer.leave();
    framer.settle(STILL, 0);
    expect(told).toEqual([]);
  });

  it('reveals a character that is not well in view, and none that does not exist', () => {
    const { framer, told, id } = framing();
    framer.reveal(['nobody']);
    framer.settle(STILL, 0);
    expect(told).toEqual([]);
    framer.reveal([id]);
    framer.settle(STILL, 0);
    framer.settle(STILL, 0);
    expect(told).toEqual(['both, 90 px covered, smoothly']);
  });

  it('frames the joint of the picked instance, at its scale', () => {
    const { select, spheres, id } = framing();
    select({ characterId: id, joint: 1 });
    select({ characterId: id, placement: 1, joint: 1 });
    select({ characterId: id, joint: 1 });
    expect(spheres.map(({ x }) => x)).toEqual([0, 10, 10]);
    expect(spheres[1].radius).toBeCloseTo(2 * spheres[0].radius, 9);
  });

  it('frames a whole character if no joint is selected, and everything if none is', () => {
    const { select, told, framer, id } = framing();
    select({ characterId: id });
    expect(told).toEqual(['both, 90 px covered, smoothly']);
    select({});
    framer.settle(STILL, 0);
    expect(told).toHaveLength(2);
  });

  it('frames all selected joints, and a little around them', () => {
    const { select, spheres, id } = framing();
    select({ characterId: id, joint: 0 });
    select({ characterId: id, joint: 0, others: [2] });
    expect(spheres[1].x).toBeCloseTo(0, 9);
    // The joints are two apart.
    expect(spheres[1].radius).toBeGreaterThan(1);
    expect(spheres[1].radius).toBeGreaterThan(spheres[0].radius / 2);
  });
});
