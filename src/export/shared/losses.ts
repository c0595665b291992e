/** Losses on the way to another program's format, with how far it is off where that can be measured. */
import { compileSkin, skinMatrices } from '../../evaluate/skin/deform.ts';
import { setIdentity } from '../../math/mat4.ts';
import type { Character } from '../../model/document.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import { isUnlimited } from '../../model/skeleton/skeleton.ts';
import { vertexCount } from '../../model/skin.ts';
import { attachmentSets } from './attachments.ts';
import { boxedJoints } from './body.ts';
import { type Bound, boundAsGiven, boundAsWritten, largestDisplacement } from './displacement.ts';
import type { FilePose } from './file-pose.ts';
import { type JointNode, NODE_WIDTH, nodeWorlds } from './joint-nodes.ts';
import type { ExchangeOptions } from './options.ts';
import { displacementText, type Loss } from './report.ts';
import type { TakeMotion } from './take-motion.ts';

/** The written file, as far as losses depend on it. */
export interface Written {
  readonly character: Character;
  readonly options: ExchangeOptions;
  readonly format: 'glTF' | 'FBX';
  readonly filePose: FilePose;
  /** The nodes of joints, where they are others than glTF's. */
  readonly chained?: { readonly nodes: readonly Pick<JointNode, 'joint' | 'place'>[]; readonly lastOf: Int32Array };
  readonly motions: readonly TakeMotion[];
  /** Names of textures that are not in the file. */
  readonly missing: readonly string[];
}

/** Everything that the file lacks or changes. */
export function lossesOf(written: Written): readonly Loss[] {
  const { missing } = written;
  return [
    ...attachmentLosses(written),
    ...bindings(written),
    ...chains(written),
    ...missing.map(
      (name): Loss => ({
        code: 'texture-left-out',
        severity: 'warning',
        message: `The texture ${name} is not in the file: it was not given, or is not an image that viewers read.`,
      }),
    ),
    ...leftOut(written),
  ];
}

/** Poses in which displacements are measured, over all takes. */
const POSES = 400;
/** Vertices times poses, at most. */
const MOST = 40_000_000;

function attachmentLosses({ character, options, format, filePose, motions }: Written): readonly Loss[] {
  const { sets, skin, joints, size } = filePose;
  if (!sets || !skin?.attachments || !joints || !character.skins.length) return [];
  const resting = joints.skeleton.joints.length;
  const whole = sets.isTrimmed ? attachmentSets(skin, resting, resting) : sets;
  const kept = options.influences ?? 4;
  const keptSets = Math.ceil(kept / 4);
  const many = verticesWhere(skin.attachments.start, (v) => {
    const { joints: j, weights } = whole;
    let count = 0;
    for (let set = 0; set < j.length; set++) for (let k = 4 * v; k < 4 * v + 4; k++) if (weights[set][k] > 0) count++;
    return count > kept;
  });
  const losses: Loss[] = [];
  const poses = matricesOf(character, filePose, motions);
  const largest = (a: Bound, b: Bound) => {
    const every = Math.max(1, Math.ceil((poses.length * a.vertices.length) / MOST));
    let most = 0;
    for (let i = 0; i < poses.length; i += every) {
      most = Math.max(most, largestDisplacement(skin.positions, a, b, poses[i]));
    }
    return most;
  };
  if (many.length > 0) {
    const cut = sets.isTrimmed ? sets : attachmentSets(skin, resting, resting, kept);
    const displacement = largest(boundAsWritten(whole, many, whole.joints.length), boundAsWritten(cut, many, keptSets));
    const count = `${many.length} of ${vertexCount(skin)} vertices have more than ${kept} attachments`;
    const off = displacementText(displacement, size);
    losses.push(
      sets.isTrimmed
        ? {
            code: 'influences-cut',
            severity: 'warning',
            displacement,
            message: `${count}, up to ${whole.most}: only the strongest ${kept} are kept, which moves a vertex by up to ${off}.`,
          }
        : {
            code: 'influences-many',
            severity: 'info',
            displacement,
            message: `${count}, up to ${whole.most}. Programs that read only four, such as three.js and Godot, are off by up to ${off}.`,
          },
    );
  }
  if (sets.isRescaled) {
    const { start, weights } = skin.attachments;
    const off = verticesWhere(start, (v) => {
      let sum = 0;
      for (let a = start[v]; a < start[v + 1]; a++) sum += weights[a];
      return start[v + 1] > start[v] && Math.abs(sum - 1) > 0.01;
    });
    const displacement = largest(
      boundAsGiven(compileSkin(skin), off, resting),
      boundAsWritten(whole, off, whole.joints.length),
    );
    losses.push({
      code: 'weights-normalised',
      severity: 'warning',
      displacement,
      message: `The weights of ${off.length} of ${vertexCount(skin)} vertices don't sum to 1. ${format} requires it, so they were normalised, which moves a vertex by up to ${displacementText(displacement, size)}.`,
    });
  }
  return losses;
}

function verticesWhere(start: Uint32Array, holds: (v: number) => boolean): Uint32Array {
  return Uint32Array.from(Array.from({ length: start.length - 1 }, (_, v) => v).filter(holds));
}

/** W·B⁻¹ of each joint, and the identity for one that never moves, in poses of all takes; or in the pose of the file. */
function matricesOf(
  character: Character,
  { skin, joints, restPose }: FilePose,
  motions: readonly TakeMotion[],
): readonly Float64Array[] {
  if (!skin || !joints) return [];
  const { nodes, lastOf } = joints.nodes;
  const compiled = compileSkin(skin);
  const row = new Float64Array(NODE_WIDTH * nodes.length + character.morphs.length);
  const worlds = new Float64Array(16 * nodes.length);
  const ofJoints = new Float64Array(16 * lastOf.length);
  const count = Math.max(compiled.matrixCount, lastOf.length);
  const matrices = () => {
    nodeWorlds(nodes, row, 0, worlds);
    lastOf.forEach((node, joint) => {
      ofJoints.set(worlds.subarray(16 * node, 16 * node + 16), 16 * joint);
    });
    const out = new Float64Array(16 * (count + 1));
    for (let j = 0; j <= count; j++) setIdentity(out, 16 * j);
    const own = new Float64Array(16 * compiled.matrixCount);
    skinMatrices(compiled, ofJoints, own);
    out.set(own);
    setIdentity(out, 16 * lastOf.length);
    return out;
  };
  if (motions.length === 0 || restPose.length === 0) {
    row.set(joints.rest);
    return [matrices()];
  }
  const perTake = Math.max(2, Math.floor(POSES / motions.length));
  return motions.flatMap(({ start, end, write }) =>
    Array.from({ length: perTake }, (_, i) => {
      write(start + ((end - start) * i) / (perTake - 1), row);
      return matrices();
    }),
  );
}

/** Bones of Blender rest where bindings are, without their scale and shear: its vertices are off by these. */
function bindings({ filePose: { skin }, character }: Written): readonly Loss[] {
  if (!skin || character.skins.length === 0) return [];
  let count = 0;
  for (let at = 0; at < skin.bindings.length; at += 16) if (!isRigid(skin.bindings, at)) count++;
  if (count === 0) return [];
  const whose = `${count} of ${skin.bindings.length / 16} bindings`;
  return [
    {
      code: 'bindings-in-blender',
      severity: 'info',
      message: `${whose} scale or shear, which Blender's bones ignore: vertices are wrong there, but right in three.js and Babylon.`,
    },
  ];
}

/** Within what files with few digits are off. */
const RIGID = 1e-2;

/** Whether the axes of a matrix (column by column) are of length 1 and at right angles. */
function isRigid(matrices: Float64Array, at: number): boolean {
  for (let a = 0; a < 3; a++) {
    for (let b = a; b < 3; b++) {
      let dot = 0;
      for (let k = 0; k < 3; k++) dot += matrices[at + 4 * a + k] * matrices[at + 4 * b + k];
      if (Math.abs(dot - (a === b ? 1 : 0)) > RIGID) return false;
    }
  }
  return true;
}

function chains({ format, chained, filePose: { joints } }: Written): readonly Loss[] {
  if (!joints) return [];
  const { nodes, lastOf } = chained ?? joints.nodes;
  const split = nodes.filter(({ place }, n) => place > 0 && lastOf[nodes[n].joint] === n);
  if (split.length === 0) return [];
  const names = split.map(({ joint }) => joints.skeleton.joints[joint].name || `joint ${joint}`);
  const more = nodes.length - lastOf.length;
  const why = format === 'glTF' ? "glTF nodes can't shear" : 'FBX nodes move, then turn, then scale';
  return [
    {
      code: 'joints-split',
      severity: 'info',
      message: `${why}: ${listed(names)} ${names.length === 1 ? 'is' : 'are'} written as chains of nodes, ${more} more than joints. The shape is the same.`,
    },
  ];
}

/** Losses of what the format has no place for. */
function leftOut({ character, options, motions, filePose }: Written): readonly Loss[] {
  const { skeleton, skins, poses, placements, driver, takes, unkeyed, morphs } = character;
  const joints = skeleton?.joints ?? [];
  const endSites = joints.reduce((sum, joint) => sum + (joint.endSites?.length ?? 0), 0);
  const hasBody = skins.length === 0 && options.body;
  const boxes = skins.length > 0 ? 0 : joints.filter(hasBox).length;
  const seen = hasBody && skeleton ? boxedJoints({ skeleton, size: filePose.size }).length : 0;
  const count = (n: number, one: string, many = `${one}s`) => (n > 0 ? [`${n} ${n === 1 ? one : many}`] : []);
  const of = (what: string, n: number, isApplied = true) =>
    count(n, 'joint').map((owners) => `${what} of ${owners}${isApplied ? ' (applied)' : ''}`);
  const things = [
    ...of(
      'limits',
      joints.filter(({ limits }) => limits.some((limit) => !isUnlimited(limit))).length,
      character.clampsToLimits,
    ),
    ...of('boxes', boxes - seen, false).map((which) => (hasBody ? `${which} (bones are shown instead)` : which)),
    ...of('linked DOFs', joints.filter(({ couples }) => couples).length),
    ...count(endSites, 'End Site').map((sites) =>
      hasBody
        ? `${sites} as ${endSites === 1 ? 'a joint' : 'joints'} (bones reach ${endSites === 1 ? 'it' : 'them'})`
        : sites,
    ),
    ...count(Math.max(0, skins.length - 1), 'other skin'),
    ...(skins.length === 0 ? count(morphs.length, 'morph without a skin', 'morphs without a skin') : []),
    ...count(poses?.length ?? 0, 'pose in the library', 'poses in the library'),
    ...count(placements.length - 1, 'further instance'),
    ...(driver ? count(takes.length, 'take of its own', 'takes of its own') : []),
    ...(options.take === undefined || driver ? [] : count(takes.length - motions.length, 'other take')),
    ...(unkeyed ? ['unkeyed changes'] : []),
    ...(filePose.joints ? [] : count(takes.length, 'take without a skeleton', 'takes without a skeleton')),
  ];
  if (things.length === 0) return [];
  return [{ code: 'parts-left-out', severity: 'info', message: `Not in the file: ${listed(things)}.` }];
}

/** `a, b and c`. */
function listed(names: readonly string[]): string {
  return names.length < 2 ? names.join('') : `${names.slice(0, -1).join(', ')} and ${names.at(-1)}`;
}
