/** Small humanoids as VRM 0.x, VRM 1.0 and VRM animations, whose joints have names that mean nothing. */
import { describe, expect, it } from 'vitest';
import { openFiles } from '../../src/files/open/open-files.ts';
import { saveCharacter } from '../../src/files/save/saving.ts';
import { type Character, EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { hasBox } from '../../src/model/skeleton/boxes.ts';
import { parse } from '../../src/worker/parse.ts';
import { captured, frameTimes, Points, pointNames, retargeted } from '../evaluate/retarget/captures.ts';
import { PARTS, type Part, person } from '../evaluate/retarget/people.ts';
import { describeShared } from '../helpers/shared.ts';
import { GltfMaker, glbOf } from './make-gltf.ts';

/** As the specification of VRM calls them. */
const BONES: Readonly<Record<string, string>> = {
  collar: 'Shoulder',
  arm: 'UpperArm',
  forearm: 'LowerArm',
  hand: 'Hand',
  thigh: 'UpperLeg',
  shin: 'LowerLeg',
  foot: 'Foot',
  toe: 'Toes',
};
const boneOf = (part: Part) => {
  const [side, own] = part.split(' ');
  return own ? `${side}${BONES[own]}` : part;
};
const bones10 = Object.fromEntries(PARTS.map((part, node) => [boneOf(part), { node }]));
const EXTENSIONS = {
  'VRM 0.x': { VRM: { humanoid: { humanBones: PARTS.map((part, node) => ({ bone: boneOf(part), node })) } } },
  'VRM 1.0': { VRMC_vrm: { specVersion: '1.0', humanoid: { humanBones: bones10 } } },
  'VRM animation': { VRMC_vrm_animation: { specVersion: '1.0', humanoid: { humanBones: bones10 } } },
};
type Kind = keyof typeof EXTENSIONS;

/** Rotation of each part at a time: about another axis each, by less than a radian. */
function turnOf(index: number, frame: number): readonly number[] {
  const angle = 0.4 * Math.sin(index + frame) * (frame > 0 ? 1 : 0);
  const axis = [Math.sin(3 * index), Math.cos(3 * index) * Math.sin(index), Math.cos(3 * index) * Math.cos(index)];
  return [...axis.map((a) => a * Math.sin(angle / 2)), Math.cos(angle / 2)];
}

const FRAMES = [0, 1, 2, 3, 4];

/** A VRM has a skin, an animation only nodes. VRM 0.x looks along −z. */
async function vrm(kind: Kind, { isMoving = kind === 'VRM animation' } = {}): Promise<Character> {
  const facing = kind === 'VRM 0.x' ? -1 : 1;
  const { joints } = person();
  const maker = new GltfMaker();
  const nodes: Record<string, unknown>[] = joints.map(({ offset: [x, y, z] }, j) => {
    const children = joints.flatMap(({ parent }, child) => (parent === j ? [child] : []));
    return { name: `n${j}`, translation: [facing * x, y, facing * z], ...(children.length && { children }) };
  });
  const roots = [0];
  let body = {};
  if (kind !== 'VRM animation') {
    const count = joints.length;
    const POSITION = maker.add(
      'VEC3',
      Float32Array.from({ length: 9 * count }, (_, i) => (i % 9 < 3 ? 0 : 0.01)),
    );
    const JOINTS_0 = maker.add(
      'VEC4',
      Uint8Array.from({ length: 12 * count }, (_, i) => (i % 4 ? 0 : Math.floor(i / 12))),
    );
    const WEIGHTS_0 = maker.add(
      'VEC4',
      Float32Array.from({ length: 12 * count }, (_, i) => (i % 4 ? 0 : 1)),
    );
    roots.push(nodes.push({ name: 'body', mesh: 0, skin: 0 }) - 1);
    body = {
      meshes: [{ primitives: [{ attributes: { POSITION, JOINTS_0, WEIGHTS_0 } }] }],
      skins: [{ joints: joints.map((_, j) => j) }],
    };
  }
  const samplers: unknown[] = [];
  const channels: unknown[] = [];
  if (isMoving) {
    const input = maker.add('SCALAR', Float32Array.from(FRAMES));
    const animate = (node: number, path: string, output: number) =>
      channels.push({ sampler: samplers.push({ input, output }) - 1, target: { node, path } });
    joints.forEach((_, j) => {
      animate(j, 'rotation', maker.add('VEC4', Float32Array.from(FRAMES.flatMap((f) => turnOf(j, f)))));
    });
    const hips = FRAMES.flatMap((f) => [0.1 * f, 0.9 + 0.02 * Math.sin(f), 0.3 * f]);
    animate(0, 'translation', maker.add('VEC3', Float32Array.from(hips)));
  }
  const extension = EXTENSIONS[kind];
  const made = maker.made({
    scene: 0,
    scenes: [{ nodes: roots }],
    nodes,
    ...body,
    ...(isMoving && { animations: [{ name: 'dance', samplers, channels }] }),
    extensionsUsed: Object.keys(extension),
    extensions: extension,
  });
  return opened(`${kind === 'VRM animation' ? 'dance.vrma' : 'figure.vrm'}`, glbOf(made));
}

async function opened(path: string, content: string | Uint8Array<ArrayBuffer>): Promise<Character> {
  const { files, broken, diagnostics } = await parse({ files: [{ path, blob: new Blob([content]) }] }, () => undefined);
  expect(diagnostics).toEqual([]);
  const [character] = openFiles(EMPTY_DOCUMENT, files, broken).document.characters;
  return { ...character, id: path };
}

const rolesIn = ({ skeleton }: Character) => skeleton?.joints.flatMap(({ role }) => role ?? []) ?? [];
const BONE_NAMES = PARTS.map(boneOf);

describe.each(Object.keys(EXTENSIONS) as Kind[])('the humanoid map of a %s', (kind) => {
  it('comes without boxes, and .skel keeps it so', async () => {
    const character = await vrm(kind);
    const again = await opened('again.skel', saveCharacter(character, 'skel')[0].text);
    expect([character, again].map(({ skeleton }) => skeleton?.joints.some(hasBox))).toEqual([false, false]);
  });

  it('names the joints, and is kept in .skel', async () => {
    const character = await vrm(kind);
    expect(rolesIn(character)).toEqual(BONE_NAMES);
    const again = await opened('again.skel', saveCharacter(character, 'skel')[0].text);
    expect(rolesIn(again)).toEqual(BONE_NAMES);
    expect(again.skeleton?.joints.map(({ name }) => name)).toEqual(character.skeleton?.joints.map(({ name }) => name));
  });
});

it.each(['VRM 1.0', 'VRM 0.x'] as const)(
  'every part of the body of a %s without takes turns, and its hips move',
  async (kind) => {
    const { skeleton } = await vrm(kind);
    const kinds = skeleton?.joints.flatMap(({ role, motion }) => (role ? [motion.kind] : []));
    expect(kinds).toEqual(PARTS.map((part) => (part === 'hips' ? 'free' : 'ball')));
  },
);

it.each(['VRM 1.0', 'VRM 0.x'] as const)('a VRM animation on a %s puts its limbs as in the animation', async (kind) => {
  const source = await vrm('VRM animation');
  const target = await vrm(kind);
  const result = retargeted(source, target);
  const [own, other] = [new Points(result), new Points(source)];
  const jointOf = (c: Character, bone: string) => c.skeleton?.joints.findIndex(({ role }) => role === bone) ?? -1;
  let farthest = 0;
  for (const time of [0, 0.5, 1, 2.5, 4]) {
    own.pose(time);
    other.pose(time);
    const at = (points: Points, c: Character, bone: string, k: number) => points.at[3 * jointOf(c, bone) + k];
    for (const bone of BONE_NAMES) {
      for (const k of [0, 1, 2]) {
        const moved = at(own, result, bone, k) - at(own, result, 'hips', k);
        const meant = at(other, source, bone, k) - at(other, source, 'hips', k);
        farthest = Math.max(farthest, Math.abs(moved - meant));
      }
    }
  }
  // Metres, of 1.64.
  expect(farthest).toBeLessThan(kind === 'VRM 1.0' ? 0.002 : 0.05);
});

describeShared('a capture on a VRM', () => {
  const LIMBS = [
    ['Arm', 'ForeArm', 'UpperArm', 'LowerArm'],
    ['ForeArm', 'Hand', 'LowerArm', 'Hand'],
    ['UpLeg', 'Leg', 'UpperLeg', 'LowerLeg'],
    ['Leg', 'Foot', 'LowerLeg', 'Foot'],
  ];

  it.each(['VRM 0.x', 'VRM 1.0'] as const)('a walk moves the right limbs of a %s by its humanoid map', async (kind) => {
    const source = captured('cmu-01_01.bvh');
    const target = await vrm(kind);
    const result = retargeted(source, target);
    const [own, other] = [new Points(result), new Points(source)];
    const direction = (points: Points, a: number, b: number) => {
      const d = [0, 1, 2].map((k) => points.at[3 * b + k] - points.at[3 * a + k]);
      return d.map((v) => v / Math.hypot(...d));
    };
    const names = pointNames(source);
    const roles = result.skeleton?.joints.map(({ role }) => role) ?? [];
    const times = frameTimes(source, 20);
    for (const side of ['left', 'right'] as const) {
      for (const [a, b, from, to] of LIMBS) {
        let sum = 0;
        for (const time of times) {
          own.pose(time);
          other.pose(time);
          const is = direction(own, roles.indexOf(side + from), roles.indexOf(side + to));
          const prefix = side === 'left' ? 'Left' : 'Right';
          const meant = direction(other, names.indexOf(prefix + a), names.indexOf(prefix + b));
          sum += Math.acos(Math.min(1, is[0] * meant[0] + is[1] * meant[1] + is[2] * meant[2]));
        }
        expect.soft((180 / Math.PI) * (sum / times.length), `${side} ${a}`).toBeLessThan(5);
      }
    }
  });
});
