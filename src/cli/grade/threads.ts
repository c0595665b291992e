/** Judges a class with as many threads as there are cores. */
import { relative } from 'node:path';
import { withoutPlace } from '../../model/diagnostic.ts';
import { shareWork, type Work } from '../threads.ts';
import type { Grade } from './grade.ts';
import { type JudgeOptions, judge, notJudged } from './judge.ts';
import { loadReference, type Reference } from './reference.ts';

/** What the threads share. */
interface Shared {
  readonly referenceFolder: string;
  readonly options: JudgeOptions;
}

/** Starting a thread takes about as long as judging a few. */
const FEW = 5;

export interface Class {
  /** Absolute. */
  readonly submissions: readonly string[];
  readonly reference: Reference;
  readonly referenceFolder: string;
  readonly options: JudgeOptions;
}

/** For the threads (`threads.ts`): each loads the reference. */
export const gradeWork: Work<Shared, string, Grade> = ({ referenceFolder, options }) => {
  const reference = loadReference(referenceFolder, referenceFolder, options.tolerance, () => undefined);
  return async (submission) => judge(submission, await reference, options);
};

/**
 * @param program what a thread runs; absent: all are judged here
 * @param told after each submission, with how many are done
 * @returns in the order of the submissions
 */
export async function judgeAll(
  { submissions, reference, referenceFolder, options }: Class,
  program: URL | undefined,
  told: (done: number, path: string) => void,
): Promise<readonly Grade[]> {
  const grades: Grade[] = new Array(submissions.length);
  let count = 0;
  await shareWork(
    {
      name: 'grade',
      // Here the reference is loaded already.
      work: () => (submission) => judge(submission, reference, options),
      shared: { referenceFolder, options },
      pieces: submissions,
      few: FEW,
      done(_, grade, i) {
        grades[i] = grade;
        told(++count, grade.path);
      },
      lost(submission, reason) {
        const path = relative(options.folder, submission);
        const message = `Grading this submission failed: ${reason}.`;
        return notJudged(path, withoutPlace('error', 'judging-failed', message, path));
      },
    },
    program,
  );
  return grades;
}
