/** The worker's side: receives a job, runs it, responds. */
import { parse } from './parse.ts';
import type { FromWorker, Progress, ToWorker } from './protocol.ts';
import { transferables } from './transferables.ts';

/** The part of a dedicated worker's global scope that is used; the project's types are those of a page. */
interface WorkerScope {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
}
// To the compiler `self` is a window; in a worker it is this.
const scope = self as unknown as WorkerScope;

scope.onmessage = async ({ data }) => {
  const { id } = data;
  try {
    const output = await parse(data.input, (progress: Progress) =>
      scope.postMessage({ id, kind: 'progress', progress }),
    );
    const message: FromWorker = { id, kind: 'done', job: data.job, output };
    scope.postMessage(message, transferables(output));
  } catch (error) {
    scope.postMessage({ id, kind: 'failed', message: error instanceof Error ? error.message : String(error) });
  }
};
