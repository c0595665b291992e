/**
 * `marrow ik`: the pose that brings points of joints to their targets, or as close as possible, starting from
 *
 *     the file pose  ←  --dofs
 *
 * within the joints' limits. As in `marrow pose`: doubles, radians, the character's own space.
 */
import { standingFeet } from '../../evaluate/ik/drag/standing-feet.ts';
import { type Bending, bendingOf, bendsWith, union } from '../../evaluate/ik/limb.ts';
import { orientationAt } from '../../evaluate/ik/orientation.ts';
import { type IkPin, ikStiffness } from '../../evaluate/ik/pins.ts';
import { ikProblem } from '../../evaluate/ik/problem.ts';
import { pointAt } from '../../evaluate/ik/set-up.ts';
import { solve } from '../../evaluate/ik/solve.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { NO_TRAVEL, placementMatrix } from '../../evaluate/space/placements.ts';
import { ZERO } from '../../math/vec3.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { FILE_EXITS } from '../io.ts';
import { loadAny, openLoaded } from '../load.ts';
import { files } from '../options/inputs.ts';
import { numbers } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { type AskedPin, PIN, REACH, resolvePin, resolveReach } from '../pin-argument.ts';
import { printJson, report } from '../report.ts';
import { UsageError } from '../usage-error.ts';

export const ik = shellCommand({
  name: 'ik',
  summary: 'Finds the pose that brings points on joints to their targets, or as close as possible.',
  inputs: files('FILE.skel', { 'FILE.skel': 'A skeleton, or another file with one.' }),
  options: {
    pin: option(
      PIN,
      'Moves a point of a joint, by default its tip or origin, to x,y,z; the joint is a name or `#index`, and pins with more weight come closer when not all can be reached.',
      { isRequired: true, isRepeated: true },
    ),
    dofs: option(numbers('v,v,…'), 'Starts from these values of all joint DOFs instead of the file pose.'),
    reach: option(
      REACH,
      'Bends only the limbs of the pinned joints, everything while planted feet are held, or all joints up to one.',
    ),
    'free-root': flag('Lets the root move as well.'),
    json: flag('Prints the pose as JSON, with the distance left at each pin.'),
  },
  examples: ['marrow ik arm.skel --pin hand=0.3,1.2,0'],
  exits: FILE_EXITS,
  async run({ inputs, options: { pin: asked, dofs: start, 'free-root': isRootFree, reach, json } }, io) {
    if (reach !== undefined && isRootFree)
      throw new UsageError("--free-root can't be used with --reach: --reach body moves the root, the others never do.");
    const opened = openLoaded(await loadAny(inputs, io.folder));
    const { diagnostics } = opened;
    report(diagnostics, io);
    const posable = opened.document.characters.filter((character) => character.skeleton);
    if (hasErrors(diagnostics) && posable.length !== 1) {
      if (json) await printJson({ diagnostics }, io);
      return 1;
    }
    const [character, another] = posable;
    if (!character) throw new UsageError('ik needs a file with a skeleton; these have none.');
    if (another) throw new UsageError(`ik takes one character; these files have ${posable.length}.`);
    const posed = poseWithPins(character, asked, start, reach ?? isRootFree);
    if (json) await printJson({ ...posed, diagnostics }, io);
    else await io.out(asText(posed));
    return hasErrors(diagnostics) ? 1 : 0;
  },
});

interface Posed {
  /** DOFs of all joints, in the order that `marrow pose --dofs` takes. */
  readonly dofs: readonly number[];
  /** Root translation, as `marrow pose` prints it. */
  readonly root: readonly number[];
  readonly iterations: number;
  /** With `--reach`: the joints that bend, ascending, or everything. */
  readonly reach?: Bending;
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
  reach: string | boolean,
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
  poseAt({ ...character, shownTake: -1 }, 0, pose);
  const first = rootDofCount(skeleton);
  if (start) pose.set(start, first);
  const { stiffness, standing, ...told } = movesOf(character, skeleton, pins, pose, reach);
  const problem = ikProblem(skeleton, [...pins, ...standing], pose, { stiffness });
  const { iterations, residuals } = solve(problem, pose, 'settle');
  return {
    dofs: Array.from(pose.subarray(first, first + count)),
    root: Array.from(compileSkeleton(skeleton).travel, (dof) => pose[dof]),
    iterations,
    ...told,
    pins: pins.map(({ joint }, p) => ({
      joint,
      position: Array.from(problem.pins.positions.subarray(3 * p, 3 * p + 3)),
      residual: residuals[p],
    })),
  };
}

interface Moves {
  readonly stiffness: Float64Array;
  /** Feet that hold by themselves. */
  readonly standing: readonly IkPin[];
  readonly reach?: Bending;
}

/** @param reach as given, or whether the root may move where everything bends */
function movesOf(
  character: Character,
  skeleton: Skeleton,
  pins: readonly IkPin[],
  pose: Float64Array,
  reach: string | boolean,
): Moves {
  if (typeof reach === 'boolean') return { stiffness: ikStiffness(skeleton, reach), standing: [] };
  const asked = resolveReach(skeleton, reach);
  const bending = union(pins.map(({ joint }) => bendingOf(skeleton, joint, asked)));
  const bends = bendsWith(skeleton, bending);
  const stiffness = ikStiffness(skeleton, bending === 'body').map((factor, dof) => (bends(dof) ? factor : Infinity));
  const standing = bending === 'body' ? feetThatHold(character, skeleton, pins, pose) : [];
  return { stiffness, standing, reach: bending };
}

function feetThatHold(
  character: Character,
  skeleton: Skeleton,
  pins: readonly IkPin[],
  pose: Float64Array,
): readonly IkPin[] {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, pose, world);
  const placement = new Float64Array(16);
  placementMatrix(DEFAULT_PLACEMENT, character.space, NO_TRAVEL, placement);
  const isAsked = (foot: number) => pins.some(({ joint }) => joint >= foot && joint < compiled.subtreeEnd[foot]);
  const feet = standingFeet(character, skeleton, world, placement).filter((foot) => !isAsked(foot));
  return feet.map((joint): IkPin => {
    const orientation = orientationAt(world, joint);
    return { joint, point: ZERO, target: pointAt(world, joint, ZERO), orientation, holds: true };
  });
}

function asText({ dofs, root, iterations, pins }: Posed): string {
  const lines = pins.map(
    ({ joint, position, residual }) => `pin on #${joint} at ${position.join(' ')}, off by ${residual}`,
  );
  return [...lines, `root ${root.join(' ')}`, `dofs ${dofs.join(',')}`, `iterations ${iterations}`, ''].join('\n');
}
