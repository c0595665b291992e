/**
 * Judges a class with as many threads as there are cores. Each asks for the next submission when it is done with one, so
 * a slow one holds up nobody; a thread that dies takes only its own submission with it.
 */
import { availableParallelism } from 'node:os';
import { relative } from 'node:path';
import { isMainThread, type MessagePort, parentPort, Worker, workerData } from 'node:worker_threads';
import { withoutPlace } from '../../model/diagnostic.ts';
import type { Grade } from './grade.ts';
import { type JudgeOptions, judge, notJudged } from './judge.ts';
import { loadReference, type Reference } from './reference.ts';

/** What a thread needs to begin with. */
interface Task {
  readonly isGrading: true;
  readonly referenceFolder: string;
  readonly options: JudgeOptions;
}

/** From a thread: undefined before its first submission. */
interface Answer {
  readonly grade?: Grade;
}

/** Starting a thread takes about as long as judging a few. */
const FEW = 4;

export interface Class {
  /** Absolute. */
  readonly submissions: readonly string[];
  readonly reference: Reference;
  readonly referenceFolder: string;
  readonly options: JudgeOptions;
}

/**
 * @param program what a thread runs, which calls `gradeInThread`; absent: all are judged here
 * @param told after each submission, with how many are done
 * @returns in the order of the submissions
 */
export async function judgeAll(
  { submissions, reference, referenceFolder, options }: Class,
  program: URL | undefined,
  told: (done: number, path: string) => void,
): Promise<readonly Grade[]> {
  const grades: Grade[] = new Array(submissions.length);
  let done = 0;
  const keep = (i: number, grade: Grade) => {
    grades[i] = grade;
    told(++done, grade.path);
  };
  if (!program || submissions.length <= FEW) {
    submissions.forEach((submission, i) => void keep(i, judge(submission, reference, options)));
    return grades;
  }
  let next = 0;
  const task: Task = { isGrading: true, referenceFolder, options };
  const work = (): Promise<void> =>
    new Promise((resolve) => {
      const worker = new Worker(program, { workerData: task });
      let current: number | undefined;
      let reason = 'the thread ended';
      worker.on('message', ({ grade }: Answer) => {
        if (grade && current !== undefined) keep(current, grade);
        current = next < submissions.length ? next++ : undefined;
        worker.postMessage(current === undefined ? null : submissions[current]);
      });
      worker.on('error', (error) => {
        reason = error.message;
      });
      worker.on('exit', () => {
        if (current === undefined) {
          resolve();
          return;
        }
        const path = relative(options.folder, submissions[current]);
        const message = `The submission stopped the judging: ${reason}.`;
        keep(current, notJudged(path, withoutPlace('error', 'judging-failed', message, path)));
        resolve(next < submissions.length ? work() : undefined);
      });
    });
  await Promise.all(Array.from({ length: Math.min(availableParallelism(), submissions.length) }, work));
  return grades;
}

/** The thread's side. @returns whether this is a thread of `judgeAll` */
export function gradeInThread(): boolean {
  // Its type is known only here and in `judgeAll`, which made it.
  const task = workerData as Task | null;
  if (isMainThread || !parentPort || !task?.isGrading) return false;
  const port: MessagePort = parentPort;
  const reference = loadReference(task.referenceFolder, task.referenceFolder, task.options.tolerance, () => undefined);
  port.on('message', (submission: string | null) => {
    if (submission === null) port.close();
    else port.postMessage({ grade: judge(submission, reference, task.options) } satisfies Answer);
  });
  port.postMessage({} satisfies Answer);
  return true;
}
