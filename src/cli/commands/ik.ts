/**
 * `marrow ik`: the pose that brings points of joints to their targets, or as close as possible, starting from
 *
 *     the file pose  ←  --dofs
 *
 * within the joints' limits. As in `marrow pose`: doubles, radians, the character's own space.
 */
import { type IkPin, ikStiffness } from '../../evaluate/ik/pins.ts';
import { ikProblem } from '../../evaluate/ik/problem.ts';
import { solve } from '../../evaluate/ik/solve.ts';
import { compileSkeleton } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../model/dofs.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { numbersOf, parseArguments, UsageError } from '../arguments.ts';
import { type CliCommand, FILE_EXITS } from '../io.ts';
import { loadAny, openLoaded } from '../load.ts';
import { printJson, report } from '../report.ts';

export const ik: CliCommand = {
  name: 'ik',
  usage: 'FILE.skel --pin JOINT[@x,y,z]=x,y,z[,weight] … [--dofs v,v,…] [--free-root] [--json]',
  summary: 'the pose that moves points on joints (a name or #index; by default tip or origin) to their targets',
  exits: FILE_EXITS,
  async run(args, io) {
    const given = parseArguments(args, { pin: 'value', dofs: 'value', 'free-root': 'flag', json: 'flag' });
    const asked = given.values('pin').map(readPin);
    if (asked.length === 0) throw new UsageError('ik needs at least one pin: --pin JOINT=x,y,z');
    const dofs = given.value('dofs');
    const start = dofs === undefined ? undefined : numbersOf('dofs', dofs);
    const opened = openLoaded(await loadAny(given.files, io.folder));
    const { diagnostics } = opened;
    report(diagnostics, io);
    const posable = opened.document.characters.filter((character) => character.skeleton);
    if (hasErrors(diagnostics) && posable.length !== 1) {
      if (given.flag('json')) await printJson({ diagnostics }, io);
      return 1;
    }
    const [character, another] = posable;
    if (!character) throw new UsageError('ik needs a file with a skeleton; these have none.');
    if (another) throw new UsageError(`ik takes one character; these files have ${posable.length}.`);
    const posed = poseWithPins(character, asked, start, given.flag('free-root'));
    if (given.flag('json')) await printJson({ ...posed, diagnostics }, io);
    else await io.out(asText(posed));
    return hasErrors(diagnostics) ? 1 : 0;
  },
};

/** A parsed `--pin`, before the skeleton is known. */
interface AskedPin {
  readonly text: string;
  readonly target: Vec3;
  readonly weight: number;
  /** The part before the `=`: a joint, optionally with a point. */
  readonly what: string;
}

function readPin(text: string): AskedPin {
  // The last one: a name may contain `=`, numbers don't.
  const equals = text.lastIndexOf('=');
  if (equals < 0) throw new UsageError(`--pin takes JOINT=x,y,z; "${text}" has no "=".`);
  const numbers = numbersOf('pin', text.slice(equals + 1));
  if (numbers.length !== 3 && numbers.length !== 4) {
    throw new UsageError(`--pin takes 3 numbers and an optional weight after "="; "${text}" has ${numbers.length}.`);
  }
  const [x, y, z, weight = 1] = numbers;
  if (!(weight > 0)) throw new UsageError(`--pin takes weights greater than 0; "${text}" has ${weight}.`);
  return { text, target: [x, y, z], weight, what: text.slice(0, equals) };
}

function resolvePin(skeleton: Skeleton, { what, target, weight, text }: AskedPin): IkPin {
  const at = what.lastIndexOf('@');
  const hasPoint = at >= 0 && !skeleton.joints.some(({ name }) => name === what);
  const joint = jointCalled(skeleton, hasPoint ? what.slice(0, at) : what);
  const point = hasPoint ? numbersOf('pin', what.slice(at + 1)) : [0, skeleton.joints[joint].length ?? 0, 0];
  if (point.length !== 3)
    throw new UsageError(`--pin takes a point as JOINT@x,y,z; "${text}" has ${point.length} numbers there.`);
  const [x, y, z] = point;
  return { joint, point: [x, y, z], target, weight };
}

/** `#index`, or a name that is unique in the skeleton. */
function jointCalled({ name: skeleton, joints }: Skeleton, called: string): number {
  if (/^#\d+$/.test(called)) {
    const index = Number(called.slice(1));
    if (index < joints.length) return index;
    throw new UsageError(`There is no joint ${called} in "${skeleton}", only #0 to #${joints.length - 1}.`);
  }
  const fits = joints.flatMap(({ name }, j) => (name === called ? [j] : []));
  if (fits.length === 1 && called !== '') return fits[0];
  if (fits.length > 1 && called !== '')
    throw new UsageError(`"${called}" is the name of ${fits.length} joints: use #${fits.join(' or #')}.`);
  const names = joints.map(({ name }, j) => name || `#${j}`);
  const some = names.length > 12 ? `${names.slice(0, 12).join(', ')} … #${names.length - 1}` : names.join(', ');
  throw new UsageError(`There is no joint "${called}" in "${skeleton}". There are: ${some}.`);
}

interface Posed {
  /** Of all joints, in the order that `marrow pose --dofs` takes. */
  readonly dofs: readonly number[];
  /** Root translation, as `marrow pose` prints it. */
  readonly root: readonly number[];
  readonly iterations: number;
  readonly pins: readonly {
    /** Index of the joint. */
    readonly joint: number;
    readonly position: readonly number[];
    /** Distance from the target. */
    readonly residual: number;
  }[];
}

function poseWithPins(
  character: Character,
  asked: readonly AskedPin[],
  start: readonly number[] | undefined,
  freeRoot: boolean,
): Posed {
  const { skeleton } = character;
  if (!skeleton) throw new UsageError('ik needs a file with a skeleton; these have none.');
  const count = jointDofCount(skeleton);
  if (start && start.length !== count) {
    throw new UsageError(
      `--dofs takes ${count} numbers, one per joint DOF of "${character.name}"; found ${start.length}.`,
    );
  }
  const pins = asked.map((pin) => resolvePin(skeleton, pin));
  const pose = new Float64Array(dofCountOf(character));
  poseAt({ ...character, shownClip: -1 }, 0, pose);
  const first = rootDofCount(skeleton);
  if (start) pose.set(start, first);
  const problem = ikProblem(skeleton, pins, pose, { stiffness: ikStiffness(skeleton, freeRoot) });
  const { iterations, residuals } = solve(problem, pose, 'settle');
  return {
    dofs: Array.from(pose.subarray(first, first + count)),
    root: Array.from(compileSkeleton(skeleton).travel, (dof) => pose[dof]),
    iterations,
    pins: pins.map(({ joint }, p) => ({
      joint,
      position: Array.from(problem.pins.positions.subarray(3 * p, 3 * p + 3)),
      residual: residuals[p],
    })),
  };
}

function asText({ dofs, root, iterations, pins }: Posed): string {
  const lines = pins.map(
    ({ joint, position, residual }) => `pin on #${joint} at ${position.join(' ')}, off by ${residual}`,
  );
  return [...lines, `root ${root.join(' ')}`, `dofs ${dofs.join(',')}`, `iterations ${iterations}`, ''].join('\n');
}
