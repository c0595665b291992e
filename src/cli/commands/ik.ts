/**
 * `marrow ik`: the pose that brings points of joints to their targets, or as close as possible, starting from
 *
 *     the file pose  ←  --dofs
 *
 * within the joints' limits. As in `marrow pose`: doubles, radians, the character's own space.
 */
import { ikStiffness } from '../../evaluate/ik/pins.ts';
import { ikProblem } from '../../evaluate/ik/problem.ts';
import { solve } from '../../evaluate/ik/solve.ts';
import { compileSkeleton } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { jointDofCount, rootDofCount } from '../../model/dofs.ts';
import { FILE_EXITS } from '../io.ts';
import { loadAny, openLoaded } from '../load.ts';
import { files } from '../options/inputs.ts';
import { numbers } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { type AskedPin, PIN, resolvePin } from '../pin-argument.ts';
import { printJson, report } from '../report.ts';
import { UsageError } from '../usage-error.ts';

export const ik = shellCommand({
  name: 'ik',
  summary: 'Solves for the pose that moves points of joints to their targets, or as close as possible.',
  inputs: files('FILE.skel', { 'FILE.skel': 'A skeleton, or another file with one.' }),
  options: {
    pin: option(
      PIN,
      'Moves a point of a joint, by default its tip or origin, to x,y,z; the joint is a name or `#index`, and pins with more weight come closer when not all can be reached.',
      { isRequired: true, isRepeated: true },
    ),
    dofs: option(numbers('v,v,…'), 'Starts from these values of all joint DOFs instead of the file pose.'),
    'free-root': flag('Lets the root move as well.'),
    json: flag('Prints the pose as JSON, with the distance left at each pin.'),
  },
  examples: ['marrow ik arm.skel --pin hand=0.3,1.2,0'],
  exits: FILE_EXITS,
  async run({ inputs, options: { pin: asked, dofs: start, 'free-root': isRootFree, json } }, io) {
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
    const posed = poseWithPins(character, asked, start, isRootFree);
    if (json) await printJson({ ...posed, diagnostics }, io);
    else await io.out(asText(posed));
    return hasErrors(diagnostics) ? 1 : 0;
  },
});

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
