/**
 * `marrow pose`: joints, and with `--vertices` the skin, of each character assembled from the files, in a pose built
 * from
 *
 *     the file pose  ←  --time or --frame (the animation)  ←  --root, --dofs, --morphs     each overriding the ones before
 *
 * and clamped to the joints' limits. All in doubles, radians, and the character's own space.
 */

import { type EndSitePosition, endSitePositions, tipPosition } from '../../evaluate/end-sites.ts';
import { applyConstraints, compileSkeleton, localMatrices, worldMatrices } from '../../evaluate/kinematics.ts';
import { limbInfos } from '../../evaluate/limbs/infos.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { blendMorphs, compileSkin, deform, skinMatrices } from '../../evaluate/skin/deform.ts';
import { isVisible } from '../../evaluate/visible-points.ts';
import { refusal } from '../../files/save/conversion.ts';
import { type Diagnostic, hasErrors } from '../../model/diagnostic.ts';
import { type Character, shownSkin, shownTake } from '../../model/document.ts';
import type { LimbInfo } from '../../model/limbs.ts';
import { jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';
import { arePoints, jointTypeOf } from '../../model/skeleton/joint-types.ts';
import { FILE_EXITS } from '../io.ts';
import { loadAny, nothingRead, openLoaded, withoutSkeleton } from '../load.ts';
import { ANY_FILE, files } from '../options/inputs.ts';
import { KEEP_OPTION } from '../options/keep.ts';
import { number, numbers, point, whole } from '../options/kinds.ts';
import { flag, type OptionValues, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { printJson, report } from '../report.ts';
import { UsageError } from '../usage-error.ts';

const POSE = {
  time: option(number('T'), 'Poses the character at this time of its take, in seconds, instead of in the file pose.'),
  frame: option(whole('N'), 'Poses the character at this frame of motion capture, counted from 0.'),
  root: option(point('x,y,z'), 'Sets the root translation.'),
  dofs: option(numbers('v,v,…'), 'Sets all joint DOFs, in the order of the skeleton, angles in radians.'),
  morphs: option(numbers('w,w,…'), 'Sets the weights of all morphs.'),
};

export const pose = shellCommand({
  name: 'pose',
  summary: 'Prints joints and vertices of a pose, or at times of a take.',
  inputs: files('FILE…', { FILE: ANY_FILE }),
  options: {
    ...POSE,
    times: option(numbers('T,T,…', 1), 'Poses the character at each of these times, in seconds.'),
    vertices: flag('Prints the vertices of the skin too, with their normals.'),
    ...KEEP_OPTION,
    json: flag('Prints JSON, which adds the local matrix L and the skinning matrix W·B⁻¹ of each joint.'),
  },
  exclusive: [['time', 'times', 'frame']],
  about: [
    'The pose is the file pose, then that of the take, then the values that are set, each overriding those before; limits are enforced.',
  ],
  examples: ['marrow pose wasp.skel wasp.skin wasp_walk.anim --time 1.5 --vertices --json'],
  exits: FILE_EXITS,
  async run({ inputs, options }, io) {
    const { times, vertices, json, keep, ...asked } = options;
    const loaded = await loadAny(inputs, io.folder, { keep });
    const opened = openLoaded(loaded);
    const { characters } = opened.document;
    const diagnostics = [
      ...opened.diagnostics,
      ...withoutSkeleton(characters),
      ...nothingRead(loaded, inputs),
      ...(loaded.files.length > 0 && characters.length === 0 ? [withoutCharacter(inputs)] : []),
    ];
    // Reported first: a broken file explains why a list doesn't match.
    report(diagnostics, io);
    if (!hasErrors(diagnostics)) {
      checkCounts(characters, asked);
      checkFrame(characters, asked);
    }
    const fitting = characters.filter((c) => fits(c, asked));
    const frames = (times ?? [asked.time]).map((time) => ({
      ...(time !== undefined && { time }),
      characters: fitting.map((c) => poseCharacter(c, { ...asked, time }, vertices)),
    }));
    if (json) await printJson({ ...(times ? { frames } : frames[0]), diagnostics }, io);
    else {
      for (const { time, characters: posed } of frames) {
        if (times) await io.out(`time ${time}\n`);
        await io.out(posed.map(asText).join('\n'));
      }
    }
    return hasErrors(diagnostics) ? 1 : 0;
  },
});

function withoutCharacter(files: readonly string[]): Diagnostic {
  const message = 'Expected a skeleton, a skin or an animation, found none that could be opened.';
  return refusal('character-missing', message, files.join(' '));
}

/** Undefined: not given, so left to the take or the files. */
type Asked = OptionValues<typeof POSE>;

/** A list applies to every character with such DOFs; a list of another length is an error. */
function checkCounts(characters: readonly Character[], { dofs, morphs }: Asked): void {
  const check = (
    option: string,
    what: string,
    list: readonly number[] | undefined,
    count: (c: Character) => number,
  ) => {
    if (!list) return;
    const having = characters.filter((c) => count(c) > 0);
    if (having.length === 0 && list.length > 0) {
      throw new UsageError(`--${option} gives ${list.length} numbers, but there are no ${what} in these files.`);
    }
    for (const character of having) {
      if (count(character) === list.length) continue;
      throw new UsageError(
        `--${option} takes ${count(character)} numbers, as many as "${character.name}" has ${what}; ` +
          `found ${list.length}.`,
      );
    }
  };
  check('dofs', 'joint DOFs', dofs, (c) => jointDofCount(c.skeleton));
  check('morphs', 'morphs', morphs, (c) => c.morphs.length);
}

/** A frame applies to every sampled character. */
function checkFrame(characters: readonly Character[], { frame }: Asked): void {
  if (frame === undefined) return;
  const sampled = characters.filter((c) => shownTake(c)?.samples);
  if (sampled.length === 0) throw new UsageError('--frame needs motion capture; these files have no samples.');
  for (const character of sampled) {
    const { frameCount = 0 } = shownTake(character)?.samples ?? {};
    if (frame >= 0 && frame < frameCount) continue;
    throw new UsageError(`--frame takes 0 to ${frameCount - 1}, the frames of "${character.name}", not ${frame}.`);
  }
}

/** Time in seconds of the character's take. */
function timeOf(character: Character, { time, frame }: Asked): number | undefined {
  const samples = shownTake(character)?.samples;
  return frame !== undefined && samples ? samples.startSeconds + frame * samples.frameSeconds : time;
}

/** After errors, the rest of a file may not match the given lists. */
function fits(character: Character, { dofs, morphs, frame = 0 }: Asked): boolean {
  const matches = (list: readonly number[] | undefined, count: number) =>
    list === undefined || count === 0 || count === list.length;
  const { frameCount = Infinity } = shownTake(character)?.samples ?? {};
  const isFrame = frame >= 0 && frame < frameCount;
  return isFrame && matches(dofs, jointDofCount(character.skeleton)) && matches(morphs, character.morphs.length);
}

interface PosedCharacter {
  readonly name: string;
  /** Root translation. */
  readonly root: readonly number[];
  /** None of points, which are in `points`. */
  readonly joints: readonly PosedJoint[];
  /** Of a capture without bones; null where a point is missing. */
  readonly points?: readonly PosedPoint[];
  /** Positions of End Sites: ends of bones without a joint there. Absent if there are none. */
  readonly endSites?: readonly EndSitePosition[];
  readonly morphs: readonly { readonly name: string; readonly weight: number }[];
  /** Limbs that the take moves to goals; absent if there are none. */
  readonly limbs?: readonly LimbInfo[];
  /** x y z per vertex. */
  readonly positions?: readonly number[];
  /** x y z per vertex, unit length. */
  readonly normals?: readonly number[];
  /** Box around the skin, or around the joints without one; null if there is neither. */
  readonly bounds: { readonly min: readonly number[]; readonly max: readonly number[] } | null;
}

interface PosedPoint {
  readonly name: string;
  readonly position: readonly number[] | null;
}

interface PosedJoint {
  readonly index: number;
  readonly name: string;
  /** -1 for the root. */
  readonly parent: number;
  readonly type: string;
  /** Clamped to the limits. */
  readonly dofs: readonly number[];
  /** World matrix: 16 numbers, column-major. */
  readonly world: readonly number[];
  /** Relative to the parent; of the root, to the character. */
  readonly local: readonly number[];
  /** W·B⁻¹; absent if the skin has no binding for it. */
  readonly skinning?: readonly number[];
  /** Tip of its bone; absent if it has none of its own. */
  readonly tip?: readonly number[];
}

function poseCharacter(character: Character, asked: Asked, withVertices: boolean): PosedCharacter {
  const values = poseValues(character, asked);
  const { skeleton, morphs } = character;
  const compiled = skeleton && compileSkeleton(skeleton);
  const world = compiled && new Float64Array(16 * compiled.jointCount);
  const local = compiled && new Float64Array(16 * compiled.jointCount);
  if (compiled && world && local) {
    worldMatrices(compiled, values, world);
    localMatrices(compiled, values, local);
  }
  const skinning = world ? skinningOf(character, world) : undefined;

  const posedPoints =
    skeleton && compiled && world && arePoints(skeleton)
      ? skeleton.joints.map(({ name }, p): PosedPoint => {
          const position = Array.from(world.subarray(16 * p + 12, 16 * p + 15));
          return { name, position: isVisible(compiled, p, values) ? position : null };
        })
      : undefined;
  const joints = (posedPoints ? [] : (skeleton?.joints ?? [])).map((joint, index) => ({
    index,
    name: joint.name,
    parent: joint.parent,
    type: jointTypeOf(joint.motion).keyword,
    dofs: compiled ? Array.from(values.subarray(compiled.firstDof[index], compiled.firstDof[index + 1])) : [],
    world: world ? matrixAt(world, index) : [],
    local: local ? matrixAt(local, index) : [],
    ...(skinning && 16 * index < skinning.length && { skinning: matrixAt(skinning, index) }),
    ...(world && joint.length !== undefined && { tip: tipPosition(joint.length, world, index) }),
  }));
  const time = timeOf(character, asked);
  // Joints that were set by hand are not those of the take.
  const limbs = time === undefined || asked.dofs || asked.root ? [] : limbInfos(character, time);
  const endSites = skeleton && world ? endSitePositions(skeleton, world, values) : [];
  const firstMorph = values.length - morphs.length;
  const { positions, normals } = deformed(character, values, firstMorph, world);
  const places = posedPoints
    ? posedPoints.flatMap(({ position }) => position ?? [])
    : joints.flatMap((joint) => joint.world.slice(12, 15));
  const points = positions ?? Float64Array.from(places);
  return {
    name: character.name,
    root: Array.from(compiled?.travel ?? ROOT, (dof) => values[dof]),
    joints,
    ...(posedPoints && { points: posedPoints }),
    ...(endSites.length > 0 && { endSites }),
    morphs: morphs.map((morph, m) => ({ name: morph.name, weight: values[firstMorph + m] })),
    ...(limbs.length > 0 && { limbs }),
    ...(withVertices && { positions: Array.from(positions ?? []), normals: Array.from(normals ?? []) }),
    bounds: boundsOf(points),
  };
}

function matrixAt(matrices: Float64Array, joint: number): number[] {
  return Array.from(matrices.subarray(16 * joint, 16 * joint + 16));
}

/** W·B⁻¹ of the joints that the shown skin has bindings for. */
function skinningOf(character: Character, world: Float64Array): Float64Array | undefined {
  const skin = shownSkin(character);
  if (!skin) return undefined;
  const compiled = compileSkin(skin);
  const out = new Float64Array(16 * compiled.matrixCount);
  skinMatrices(compiled, world, out);
  return out;
}

/** The character's DOFs, in the order of `model/dofs.ts`. */
function poseValues(character: Character, asked: Asked): Float64Array {
  const { root, dofs, morphs } = asked;
  const time = timeOf(character, asked);
  const values = new Float64Array(dofCountOf(character));
  // Without a time the animation is ignored.
  poseAt(time === undefined ? { ...character, shownTake: -1 } : character, time ?? 0, values);
  const { skeleton } = character;
  const own = rootDofCount(skeleton);
  if (root && own) values.set(root, 0);
  if (dofs && skeleton) values.set(dofs, own);
  if (morphs && character.morphs.length) values.set(morphs, values.length - morphs.length);
  if (!skeleton) return values;
  const compiled = compileSkeleton(skeleton);
  applyConstraints(compiled, values, character.clampsToLimits);
  // A root joint with translation DOFs sets its own position within its limits; `--root` is added to it.
  if (root && !own) {
    compiled.travel.forEach((dof, k) => {
      values[dof] += root[k];
    });
  }
  return values;
}

/** DOFs of the root translation for a character without a skeleton. */
const ROOT = [0, 1, 2];

function deformed(character: Character, values: Float64Array, firstMorph: number, world: Float64Array | undefined) {
  const skin = shownSkin(character);
  if (!skin) return {};
  const compiled = compileSkin(skin);
  const positions = new Float64Array(skin.positions.length);
  const normals = new Float64Array(skin.positions.length);
  blendMorphs(compiled, character.morphs, values, firstMorph, positions, normals);
  deform(compiled, world, positions, normals, positions, normals);
  return { positions, normals };
}

function boundsOf(points: Float64Array): PosedCharacter['bounds'] {
  if (points.length === 0) return null;
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) {
    min[i % 3] = Math.min(min[i % 3], points[i]);
    max[i % 3] = Math.max(max[i % 3], points[i]);
  }
  return { min, max };
}

function asText(posed: PosedCharacter): string {
  const { name, root, joints, points = [], endSites = [], limbs = [], morphs, positions, normals, bounds } = posed;
  const lines = [`character ${name}, root ${root.join(' ')}`];
  for (const joint of joints) {
    lines.push(
      `  ${joint.index} ${joint.name || '(no name)'} (${joint.type}, parent ${joint.parent}): ${joint.dofs.join(' ')}`,
      ...[0, 1, 2, 3].map((row) => `      ${[0, 4, 8, 12].map((column) => joint.world[column + row]).join(' ')}`),
      ...(joint.tip ? [`      tip ${joint.tip.join(' ')}`] : []),
    );
  }
  for (const { name: label, position } of points) lines.push(`  ${label}: ${position?.join(' ') ?? 'missing'}`);
  for (const { joint, position } of endSites) lines.push(`  end site of ${joint}: ${position.join(' ')}`);
  for (const { name: limb, blend, space, goal, gap } of limbs) {
    lines.push(`  limb ${limb}: blend ${blend}, goal ${goal.join(' ')} in ${space}, gap ${gap}`);
  }
  for (const morph of morphs) lines.push(`  morph ${morph.name}: ${morph.weight}`);
  for (let o = 0; positions && normals && o < positions.length; o += 3) {
    const [position, normal] = [positions, normals].map((list) => list.slice(o, o + 3).join(' '));
    lines.push(`  vertex ${o / 3}: ${position}  normal ${normal}`);
  }
  if (bounds) lines.push(`  bounds ${bounds.min.join(' ')} to ${bounds.max.join(' ')}`);
  return `${lines.join('\n')}\n`;
}
