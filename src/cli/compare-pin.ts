/** `marrow compare --pin`: numbers of a program of inverse kinematics, against the target that it was given. */
import { countOf } from '../lesson/compare.ts';
import { comparedText } from '../lesson/compared-text.ts';
import { compareGoal, type GoalComparison } from '../lesson/ik/compare-goal.ts';
import { effectorText } from '../lesson/ik/goal.ts';
import type { FrameTarget, Targets } from '../lesson/targets.ts';
import type { Diagnostic } from '../model/diagnostic.ts';
import type { Character } from '../model/document.ts';
import { type Arguments, UsageError } from './arguments.ts';
import { causeJson, causesLines, short } from './compare-text.ts';
import type { CommandIo, ExitCode } from './io.ts';
import { type AskedPin, resolvePin } from './pin-argument.ts';
import { printJson } from './report.ts';

/** Prints the comparison and returns the exit code. @throws UsageError if the pin or the dump doesn't fit */
export async function compareWithPin(
  character: Character,
  targets: Targets,
  pin: AskedPin,
  given: Arguments,
  tolerance: number,
  diagnostics: readonly Diagnostic[],
  io: CommandIo,
): Promise<ExitCode> {
  const { skeleton } = character;
  if (!skeleton) throw new UsageError('--pin needs a file with a skeleton; these have none.');
  const goal = resolvePin(skeleton, pin);
  const isOneStep = given.flag('one-step');
  const frame = frameOf(targets, isOneStep);
  const found = compareGoal(character, skeleton, frame, goal, isOneStep, tolerance);
  const compared = countOf(targets.frames, targets.channels.channels);
  const { agrees, hasMoved, isPose, before, after, causes } = found;
  if (given.flag('json')) {
    const of = {
      joint: goal.joint,
      point: goal.point,
      target: goal.target,
      before,
      ...(after !== undefined && { after }),
    };
    await printJson({ agrees, compared, pin: of, hasMoved, isPose, causes: causes.map(causeJson), diagnostics }, io);
  } else {
    const lines = [
      `Compared: ${comparedText(compared, 1)}.`,
      ...placeLines(effectorText(skeleton, goal), found, isOneStep),
      ...causesLines(causes, compared, false),
    ];
    await io.out(`${lines.join('\n')}\n`);
  }
  return agrees ? 0 : 1;
}

/** The only frame, with numbers of joints. */
function frameOf({ frames, channels }: Targets, isOneStep: boolean): FrameTarget {
  if (channels.channels.length > 0) throw new UsageError('--pin takes numbers of joints; the dump has channels.');
  const [frame] = frames;
  if (frames.length !== 1) throw new UsageError(`--pin takes a dump of one time; found ${frames.length}.`);
  const { world, local, positions, vertices, normals } = frame;
  if (vertices || normals) throw new UsageError('--pin takes numbers of joints; the dump has vertices or normals.');
  if (!(world || positions || (isOneStep && local)))
    throw new UsageError('--pin takes world matrices or joint positions; the dump has local matrices.');
  return frame;
}

function placeLines(
  what: string,
  { agrees, hasMoved, isPose, before, after, causes }: GoalComparison,
  isOneStep: boolean,
) {
  const start = what.charAt(0).toUpperCase() + what.slice(1);
  const away = after === undefined ? '' : `, ${short(after)} away`;
  if (!isPose) return ['No pose of the skeleton has these numbers: its bones have other lengths, axes or limits.'];
  if (agrees && isOneStep) return [`A right step of ${what}: ${short(before)} from its target before${away} after it.`];
  if (agrees) return [`${start} is at its target, or as near as it can get${away}; ${short(before)} away before.`];
  const lines = [`${start} is not at its target${away}; ${short(before)} away before.`];
  if (causes.length > 0) return lines;
  if (!hasMoved) return [...lines, 'All joints are where they were before.'];
  const none = isOneStep
    ? 'It is no step of α·Jᵀe, damped least squares or the pseudo-inverse, and no known mistake explains these numbers. A longer step, or a smaller --tolerance, tells more.'
    : 'No known mistake explains these numbers. Those after one step of your solver, with --one-step, tell more.';
  return [...lines, '', none];
}
