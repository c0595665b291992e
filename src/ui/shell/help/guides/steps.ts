/** The steps of each guide, and when each is done: by what changed since it began. */
import type { Document } from '../../../../model/document.ts';
import type { Selection } from '../../../../model/session.ts';
import type { GuideName } from '../../../state/guide.ts';
import type { ManualPage } from '../../../state/manual-link.ts';
import type { TimelineTabName } from '../../../state/timeline.ts';

/** What the steps are judged by. */
export interface GuideState {
  readonly document: Document;
  readonly selection: Selection;
  readonly isPlaying: boolean;
  /** Seconds. */
  readonly time: number;
  /** The open tab of the timeline; undefined while that is closed. */
  readonly tab: TimelineTabName | undefined;
  readonly isUnsaved: boolean;
  /** Another program's numbers that a character is compared with; another object for others. */
  readonly comparing: object | undefined;
}

export interface GuideStep {
  /** What to do, in bold, and the rest of the sentence. */
  readonly what: string;
  readonly how: string;
  /** An action that does it, and its name on a button. */
  readonly action?: readonly [label: string, id: string];
  /** @param since the state when the step began */
  isDone(now: GuideState, since: GuideState): boolean;
}

export interface Guide {
  readonly title: string;
  readonly about: string;
  readonly page: ManualPage;
  readonly steps: readonly GuideStep[];
}

/** Whether a character's takes changed, which posing doesn't. */
function isKeyed({ document }: GuideState, since: GuideState): boolean {
  return document.characters.some(({ id, takes }) => {
    const was = since.document.characters.find((one) => one.id === id);
    return was !== undefined && was.takes !== takes;
  });
}

/** Whether a character was posed, with or without a key. */
function isPosed(now: GuideState, since: GuideState): boolean {
  if (isKeyed(now, since)) return true;
  return now.document.characters.some(({ id, pose, unkeyed }) => {
    const was = since.document.characters.find((one) => one.id === id);
    return was !== undefined && (was.pose !== pose || (unkeyed !== undefined && was.unkeyed !== unkeyed));
  });
}

export const GUIDE_TEXTS: Readonly<Record<GuideName, Guide>> = {
  firstAnimation: {
    title: 'First animation',
    about: 'Make the character wave, and save it. Every step can be undone.',
    page: 'guide/first-animation.html',
    steps: [
      {
        what: 'Pause',
        how: 'with Space.',
        action: ['Pause', 'play.toggle'],
        isDone: (now) => !now.isPlaying,
      },
      {
        what: 'Drag a hand up',
        how: 'in Pose mode: elbow and shoulder follow. What changed is orange.',
        isDone: isPosed,
      },
      {
        what: 'Key it',
        how: 'with K. Only what you changed gets keys.',
        action: ['Key', 'key.changed'],
        isDone: isKeyed,
      },
      {
        what: 'Move on',
        how: 'by some frames: drag in the ruler, or press →.',
        isDone: (now, since) => Math.abs(now.time - since.time) > 0.05,
      },
      {
        what: 'Pose and key again:',
        how: 'the hand a bit lower, then K. Two or three poses make a wave.',
        action: ['Key', 'key.changed'],
        isDone: isKeyed,
      },
      {
        what: 'See its curves',
        how: 'with C. Drag keys, or the handles of tangents.',
        action: ['Curve editor', 'page.tab.curves'],
        isDone: ({ tab }) => tab === 'curves',
      },
      {
        what: 'Save',
        how: 'with Ctrl+S. Play to see the wave.',
        action: ['Save', 'save.changed'],
        isDone: ({ isUnsaved }) => !isUnsaved,
      },
    ],
  },
  checkProgram: {
    title: 'Check your program',
    about:
      'Compare your program’s numbers with Marrow’s: the first one that is wrong is named, with the mistake that explains it.',
    page: 'guide/check-your-program.html',
    steps: [
      {
        what: 'Open the character',
        how: 'that your program shows: its .skel, with .skin or .anim if it has them.',
        action: ['Open…', 'file.open'],
        isDone: ({ document }) => document.characters.length > 0 && !document.isOpeningSample,
      },
      {
        what: 'Print your numbers:',
        how: 'each joint’s world matrix, one per line. The Compare tab has lines of code to copy.',
        action: ['Compare', 'page.tab.compare'],
        isDone: ({ tab, comparing }) => tab === 'compare' || comparing !== undefined,
      },
      {
        what: 'Drop the file here,',
        how: 'or paste the numbers into the tab.',
        isDone: ({ comparing }) => comparing !== undefined,
      },
      {
        what: 'Click a joint',
        how: 'that is marked red: its own numbers are wrong. Hatched ones only inherit it.',
        isDone: ({ selection }, since) => selection.joint !== undefined && selection !== since.selection,
      },
      {
        what: 'Correct your program,',
        how: 'run it, and drop the file again.',
        isDone: ({ comparing }, since) => comparing !== undefined && comparing !== since.comparing,
      },
    ],
  },
};

/** How far a guide is: steps done, and the state when the next began. */
export interface GuideProgress {
  readonly done: number;
  readonly since: GuideState;
}

/** Ticks off what is done now. A step that is met when it begins is done at once. */
export function advanced({ steps }: Guide, progress: GuideProgress, now: GuideState): GuideProgress {
  let { done, since } = progress;
  while (done < steps.length && steps[done].isDone(now, since)) {
    done++;
    since = now;
  }
  return done === progress.done ? progress : { done, since };
}
