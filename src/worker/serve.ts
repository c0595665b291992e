/** The worker's side of `WorkerClient`: receives jobs, runs them, responds. */
import { sentenceOf } from '../model/failure.ts';
import { passageOf } from './passage.ts';
import type { Done, FromWorker, JobName, ToWorker } from './protocol.ts';

/** The part of a dedicated worker's global scope that is used; the project's types are those of a page. */
interface WorkerScope {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
}
// To the compiler `self` is a window; in a worker it is this.
const scope = self as unknown as WorkerScope;

/** Answers each job by `run`, which may throw. @param run takes what posts messages before the last one */
export function serve<Names extends JobName>(
  run: (job: ToWorker<Names>, post: WorkerScope['postMessage']) => Promise<Done<Names>>,
): void {
  scope.onmessage = async ({ data }) => {
    try {
      // Whoever starts a worker only gives it the jobs that it does; what it answers is one of all answers.
      const done = (await run(data as ToWorker<Names>, (message, transfer) =>
        scope.postMessage(message, transfer),
      )) as Done;
      scope.postMessage(done, passageOf(done.output).transfer);
    } catch (error) {
      scope.postMessage({ id: data.id, kind: 'failed', message: sentenceOf(error) });
    }
  };

  // A worker that the browser ends says nothing; but the browser releases its locks. Plain http has none.
  const locks = navigator.locks as LockManager | undefined;
  const lock = `marrow-worker-${crypto.getRandomValues(new Uint32Array(4)).join('-')}`;
  void locks?.request(lock, () => {
    scope.postMessage({ kind: 'alive', lock });
    return new Promise<never>(() => undefined);
  });
}
