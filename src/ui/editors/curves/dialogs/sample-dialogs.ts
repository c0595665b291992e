/** Dialogs of the sample tools; those without questions are in `timeline/sample-tools.ts`. */
import {
  type ConvertToKeys,
  convertSteps,
  convertToKeys,
  type ResampleSamples,
  resampleSamples,
  resampleSteps,
  type SmoothSamples,
  smoothSamples,
  smoothSteps,
} from '../../../../edit/commands/samples.ts';
import { type Converted, usualTolerance } from '../../../../edit/samples/convert.ts';
import { MEDIAN_FRAMES } from '../../../../edit/samples/median.ts';
import { type Character, type Document, findCharacter, shownTake } from '../../../../model/document.ts';
import { jointName } from '../../../../model/skeleton/joint-name.ts';
import type { Samples } from '../../../../model/takes/samples.ts';
import { shownPerUnit, unitText } from '../../../state/joints/angles.ts';
import { lengthUnit } from '../../../state/joints/length-unit.ts';
import type { Uses } from '../../../state/workbench.ts';
import type { DialogContent } from '../../../widgets/dialog.ts';
import { element } from '../../../widgets/dom.ts';
import { type Asked, askChoice, askNumber } from '../../../widgets/form/form.ts';
import { count, errorSize, plural, shown } from '../../../widgets/numbers/number-text.ts';
import { type CurrentTake, currentTake, ownChannelsToEdit } from '../../timeline/current-take.ts';
import { toolDialog } from '../../timeline/tool-dialog.ts';

export function convertDialog(
  wb: Uses<'store' | 'timeline' | 'settings' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  return withSamples(wb, ({ character, take }, samples, channels) => {
    const { angles } = wb.settings.get();
    const usual = usualTolerance(character.skeleton);
    const all = take.channels.filter(({ kind }) => kind === 'samples').length;
    return toolDialog<ConvertToKeys>(wb, close, {
      title: 'Convert to keys',
      about:
        `Fits as few keys as possible to ${count(samples.frameCount)} frames: curves are fitted after an Euler filter, then ` +
        'refined until every joint and End Site is within tolerance at every frame.',
      asked: [
        ...channelsAsked(wb, channels.length, all),
        askNumber('position', 'Position tolerance', Number(usual.position.toPrecision(2)), {
          unit: lengthUnit(character),
        }),
        askNumber('angle', 'Rotation tolerance', Number((usual.angle * shownPerUnit('angle', angles)).toPrecision(2)), {
          unit: unitText('angle', angles).trim(),
        }),
      ],
      command: convertToKeys,
      args: (answers) => ({
        characterId: character.id,
        channels: answers.choice('channels') === 'view' ? channels : undefined,
        tolerance: {
          position: answers.number('position'),
          angle: answers.number('angle') / shownPerUnit('angle', angles),
        },
      }),
      *steps(document, args) {
        const { edit, report } = yield* convertSteps(document, args);
        return { change: edit, text: convertedText(wb, character, report) };
      },
    });
  });
}

export function smoothDialog(
  wb: Uses<'store' | 'transport' | 'timeline' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  return withSamples(wb, ({ character, take }, samples, channels) => {
    const all = take.channels.filter(({ kind }) => kind === 'samples').length;
    const [from, to] = wb.transport.get().range;
    const offset = character.timeOffsetSeconds;
    return toolDialog<SmoothSamples>(wb, close, {
      title: 'Smooth samples',
      about:
        'Filters each frame over its neighbours on both sides, so the motion is not delayed. Joints with three angles are ' +
        'filtered as rotations. Within a range, the effect fades in and out.',
      asked: [
        ...channelsAsked(wb, channels.length, all),
        askChoice('filter', 'Filter', { gaussian: 'Gaussian', median: 'Median (removes spikes)' }),
        askNumber('sigma', 'Width (σ)', 0.05, {
          unit: 's',
          shownIf: (answers) => answers.choice('filter') === 'gaussian',
        }),
        askChoice(
          'frames',
          'Width',
          MEDIAN_FRAMES.map((frames) => [String(frames), `${frames} frames`]),
          { value: String(MEDIAN_FRAMES[0]), shownIf: (answers) => answers.choice('filter') === 'median' },
        ),
        askChoice('range', 'Over', { take: 'Whole take', played: `Playback range, ${shown(from)} – ${shown(to)} s` }),
      ],
      command: smoothSamples,
      args: (answers) => ({
        characterId: character.id,
        channels: answers.choice('channels') === 'view' ? channels : undefined,
        range: answers.choice('range') === 'played' ? ([from + offset, to + offset] as const) : undefined,
        ...(answers.choice('filter') === 'median'
          ? { filter: 'median', frames: Number(answers.choice('frames')) }
          : { filter: 'gaussian', sigmaSeconds: answers.number('sigma') }),
      }),
      *steps(document, args) {
        const change = yield* smoothSteps(document, args);
        return { change, text: smoothedText(args, samples, samplesOf(change, character.id)) };
      },
    });
  });
}

export function resampleSamplesDialog(
  wb: Uses<'store' | 'timeline' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  return withSamples(wb, ({ character }, samples) => {
    const own = 1 / samples.frameSeconds;
    const preset = shownRate(own);
    return toolDialog<ResampleSamples>(wb, close, {
      title: 'Resample samples',
      about: 'The same motion at another frame rate. Rotations take the shortest path between frames.',
      asked: [askNumber('rate', 'Frames per second', preset)],
      command: resampleSamples,
      args(answers) {
        const rate = answers.number('rate');
        // The take's own rate, if the field still shows it rounded.
        return { characterId: character.id, framesPerSecond: rate === preset ? own : rate };
      },
      *steps(document, args) {
        const change = yield* resampleSteps(document, args);
        const now = samplesOf(change, character.id);
        const text =
          now === samples ? `The take already has ${preset} frames per second.` : resampledText(samples, now);
        return { change, text };
      },
    });
  });
}

/**
 * A frame rate as people say it: 60 for a frame time of 0.016667 s. Rounded only if much closer to a whole number than
 * 29.97, television's rate, is to 30.
 */
export function shownRate(framesPerSecond: number): number {
  const whole = Math.round(framesPerSecond);
  const isNear = Math.abs(framesPerSecond - whole) < 5e-4 * whole;
  return isNear ? whole : Number(framesPerSecond.toPrecision(5));
}

function smoothedText(args: SmoothSamples, before: Samples, after: Samples | undefined): string {
  const { sigmaSeconds } = args;
  if (args.filter === 'median' || sigmaSeconds === undefined) {
    const changed = framesChanged(before, after ?? before);
    return changed ? `${plural(changed, 'frame')} of ${count(before.frameCount)} changed.` : 'No spikes found.';
  }
  const frames = sigmaSeconds / before.frameSeconds;
  const halved = (Math.PI * sigmaSeconds) / Math.sqrt(Math.LN2 / 2);
  return `σ is ${shown(frames, 1)} frames: motion at ${shown(1 / halved, 1)} Hz is halved.`;
}

/** Number of frames in which any value differs. */
function framesChanged({ values, scales, frameCount }: Samples, after: Samples): number {
  if (after.values === values) return 0;
  let changed = 0;
  for (let f = 0; f < frameCount; f++) {
    const end = (f + 1) * scales.length;
    let at = f * scales.length;
    while (at < end && values[at] === after.values[at]) at++;
    if (at < end) changed++;
  }
  return changed;
}

function resampledText({ frameCount }: Samples, now: Samples | undefined): string {
  return `${count(frameCount)} → ${plural(now?.frameCount ?? 0, 'frame')}.`;
}

function samplesOf(document: Document, characterId: string): Samples | undefined {
  const changed = findCharacter(document, characterId);
  return changed && shownTake(changed)?.samples;
}

/** Asks whether to use the selected channels or all, if that differs. */
function channelsAsked(wb: Uses<'store' | 'timeline'>, inHand: number, all: number): Asked[] {
  if (inHand === all || inHand === 0) return [];
  // With a joint selected and only its channels listed, those are meant.
  const { selection } = wb.store;
  const isOfJoint = wb.timeline.view.get().list === 'selected' && selection.joint !== undefined;
  return [
    askChoice(
      'channels',
      'Curves',
      {
        all: `All ${count(all)} curves`,
        view: inHand === 1 ? 'Only the visible one' : `Only the ${count(inHand)} visible`,
      },
      { value: isOfJoint ? 'view' : 'all' },
    ),
  ];
}

/**
 * `202,554 samples → 12,408 keys (16 to 1). Furthest off: LeftHand by 0.48 cm at 12.2 s; turned most: Head by 0.9° at
 * 3.1 s.`
 */
function convertedText(wb: Uses<'settings'>, character: Character, report: Converted): string {
  const { angles } = wb.settings.get();
  const { samplesBefore, keysAfter, worstPosition, worstAngle } = report;
  const { skeleton, timeOffsetSeconds } = character;
  const nameOf = (joint: number) => jointName(skeleton, joint);
  const at = (time: number) => `at ${shown(time - timeOffsetSeconds)} s`;
  const off = `${errorSize(worstPosition.error)} ${lengthUnit(character)}`;
  const turned = `${errorSize(worstAngle.error * shownPerUnit('angle', angles))}${unitText('angle', angles)}`;
  return [
    `${plural(samplesBefore, 'sample')} → ${plural(keysAfter, 'key')}, ${shown(samplesBefore / keysAfter, 1)} to 1.`,
    `Largest position error: ${nameOf(worstPosition.joint)}, ${off} ${at(worstPosition.atSeconds)}.`,
    `Largest rotation error: ${nameOf(worstAngle.joint)}, ${turned} ${at(worstAngle.atSeconds)}.`,
  ].join('\n');
}

function withSamples(
  wb: Uses<'store' | 'timeline'>,
  make: (current: CurrentTake, samples: Samples, channels: readonly number[]) => DialogContent,
): DialogContent {
  const current = currentTake(wb);
  const samples = current?.take.samples;
  if (current && samples) {
    return make(
      current,
      samples,
      ownChannelsToEdit(wb).filter((c) => current.take.channels[c]?.kind === 'samples'),
    );
  }
  const body = element('p', { class: 'empty' }, 'This take has no samples.');
  return { title: 'Samples', body, kind: 'tool-dialog' };
}
