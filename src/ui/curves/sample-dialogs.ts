/** What each of the tools for samples asks; those that need nothing asked are in `timeline/sample-tools.ts`. */
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
} from '../../edit/commands/samples.ts';
import type { Converted } from '../../edit/samples/convert.ts';
import { isSampled } from '../../model/clip.ts';
import { type Document, findCharacter, shownClip } from '../../model/document.ts';
import type { Samples } from '../../model/samples.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { shownPerUnit, unitText } from '../angles.ts';
import type { DialogContent } from '../dialog.ts';
import { element } from '../dom.ts';
import { count, plural, seconds, shown } from '../number-text.ts';
import { channelsInHand, type Take, takeInHand } from '../timeline/in-hand.ts';
import type { Workbench } from '../workbench.ts';
import { type Asked, toolDialog } from './tool-dialog.ts';

/** Of the skeleton's size: what is hardly seen of a joint. */
const POSITION_PART = 0.005;
const ANGLE_DEGREES = 1;

export function convertDialog(wb: Workbench, close: () => void): DialogContent {
  return withSamples(wb, ({ character, clip }, samples, channels) => {
    const { angles } = wb.settings.get();
    const degrees = angles === 'degrees' ? ANGLE_DEGREES : Number(((ANGLE_DEGREES * Math.PI) / 180).toPrecision(2));
    const all = clip.channels.reduce((sum, _, c) => sum + (isSampled(clip, c) ? 1 : 0), 0);
    const { skeleton } = character;
    return toolDialog<ConvertToKeys>(wb, close, {
      name: 'convertToKeys',
      title: 'Convert to keys',
      about:
        `Fewest keys for ${count(samples.frameCount)} frames with every joint and End Site where it was: cubics fitted ` +
        'to each curve, angles freed of jumps first, and all joints measured at every frame until none is further off there.',
      asked: [
        ...channelsAsked(channels.length, all),
        {
          kind: 'number',
          name: 'position',
          label: 'Joints within',
          value: Number((POSITION_PART * (skeleton ? sizeOf(skeleton) : 1)).toPrecision(2)),
        },
        {
          kind: 'number',
          name: 'angle',
          label: 'Turned within',
          value: degrees,
          unit: unitText('angle', angles).trim(),
        },
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
        return { change: edit, text: convertedText(wb, skeleton, report, character.timeOffsetSeconds) };
      },
      result: () => '',
    });
  });
}

export function smoothDialog(wb: Workbench, close: () => void): DialogContent {
  return withSamples(wb, ({ character, clip }, samples, channels) => {
    const all = clip.channels.reduce((sum, _, c) => sum + (isSampled(clip, c) ? 1 : 0), 0);
    return toolDialog<SmoothSamples>(wb, close, {
      name: 'smoothSamples',
      title: 'Smooth samples',
      about:
        'A Gaussian over the frames around each, alike to both sides, so that nothing comes later. ' +
        'Joints with three angles are smoothed as rotations.',
      asked: [
        ...channelsAsked(channels.length, all),
        { kind: 'number', name: 'sigma', label: 'Width (σ)', value: 0.05, unit: 's' },
      ],
      command: smoothSamples,
      args: (answers) => ({
        characterId: character.id,
        channels: answers.choice('channels') === 'view' ? channels : undefined,
        sigmaSeconds: answers.number('sigma'),
      }),
      *steps(document, args) {
        return { change: yield* smoothSteps(document, args), text: smoothedText(args.sigmaSeconds, samples) };
      },
      result: ({ sigmaSeconds }) => smoothedText(sigmaSeconds, samples),
    });
  });
}

export function resampleSamplesDialog(wb: Workbench, close: () => void): DialogContent {
  return withSamples(wb, ({ character }, samples) =>
    toolDialog<ResampleSamples>(wb, close, {
      name: 'resampleSamples',
      title: 'Resample samples',
      about: 'The same motion at another frame rate; joints turn along their way from rotation to rotation.',
      asked: [
        {
          kind: 'number',
          name: 'rate',
          label: 'Frames per second',
          value: Number((1 / samples.frameSeconds).toPrecision(6)),
        },
      ],
      command: resampleSamples,
      args: (answers) => ({ characterId: character.id, framesPerSecond: answers.number('rate') }),
      *steps(document, args) {
        const change = yield* resampleSteps(document, args);
        return { change, text: resampledText(samples, change, character.id) };
      },
      result: (_args, after) => resampledText(samples, after, character.id),
    }),
  );
}

function smoothedText(sigmaSeconds: number, { frameSeconds }: Samples): string {
  const frames = sigmaSeconds / frameSeconds;
  const halved = (Math.PI * sigmaSeconds) / Math.sqrt(Math.LN2 / 2);
  return `σ is ${shown(frames, 1)} frames: of what goes to and fro ${shown(1 / halved, 1)} times a second half is left.`;
}

function resampledText({ frameCount }: Samples, after: Document, characterId: string): string {
  const changed = findCharacter(after, characterId);
  const now = changed && shownClip(changed)?.samples;
  return `${count(frameCount)} → ${plural(now?.frameCount ?? 0, 'frame')}.`;
}

/** Whether the tool's channels are those in hand or all, where that is not the same. */
function channelsAsked(inHand: number, all: number): Asked[] {
  if (inHand === all || inHand === 0) return [];
  return [
    {
      kind: 'choice',
      name: 'channels',
      label: 'Curves',
      value: 'all',
      options: [
        ['all', `All ${count(all)}`],
        ['view', `The ${count(inHand)} in view`],
      ],
    },
  ];
}

/** `202,554 samples → 12,408 keys (16 to 1). Furthest off: LeftHand 0.48 at 12.2 s; turned most: Head 0.9° at 3.1 s.` */
function convertedText(
  wb: Workbench,
  skeleton: Skeleton | undefined,
  report: Converted,
  offsetSeconds: number,
): string {
  const { angles } = wb.settings.get();
  const { samplesBefore, keysAfter, worstPosition, worstAngle } = report;
  const nameOf = (joint: number) => skeleton?.joints[joint]?.name || `joint ${joint}`;
  const at = (time: number) => `at ${seconds(Number((time - offsetSeconds).toFixed(3)))} s`;
  const turned = `${shown(worstAngle.error * shownPerUnit('angle', angles), 3)}${unitText('angle', angles)}`;
  return [
    `${plural(samplesBefore, 'sample')} → ${plural(keysAfter, 'key')}, ${shown(samplesBefore / keysAfter, 1)} to 1.`,
    `Furthest off: ${nameOf(worstPosition.joint)} by ${shown(worstPosition.error, 4)} ${at(worstPosition.atSeconds)}.`,
    `Turned most: ${nameOf(worstAngle.joint)} by ${turned} ${at(worstAngle.atSeconds)}.`,
  ].join('\n');
}

/** The longest side of the box around the joints at rest. */
function sizeOf({ joints }: Skeleton): number {
  const at: number[][] = [];
  for (const { parent, offset } of joints) at.push(offset.map((v, k) => v + (parent < 0 ? 0 : at[parent][k])));
  const sides = [0, 1, 2].map((k) => Math.max(...at.map((p) => p[k])) - Math.min(...at.map((p) => p[k])));
  return Math.max(...sides) || 1;
}

function withSamples(
  wb: Workbench,
  make: (take: Take, samples: Samples, channels: readonly number[]) => DialogContent,
): DialogContent {
  const take = takeInHand(wb);
  const samples = take?.clip.samples;
  if (take && samples) {
    return make(
      take,
      samples,
      channelsInHand(wb).filter((c) => isSampled(take.clip, c)),
    );
  }
  const body = element('p', { class: 'empty' }, 'This take has no samples.');
  return { title: 'Samples', body, kind: 'tool-dialog' };
}
