/**
 * The page's side of the worker. Cancelling a job terminates its worker: parsers are synchronous, and a new worker
 * costs a few milliseconds, whereas an abort flag would slow down every inner loop.
 */

import { sentenceOf } from '../model/failure.ts';
import { UserError } from '../model/user-error.ts';
import type { FromWorker, JobName, Jobs, ParsedPart, ParseOutput, Progress, ToWorker } from './protocol.ts';
import { isIncomplete, withCharacters } from './tracked-takes.ts';

/** The part of `Worker` that the client uses; tests pass one without a thread. */
export interface WorkerLike {
  postMessage(message: ToWorker): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<FromWorker>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  onmessageerror: ((event: MessageEvent) => void) | null;
}

export interface JobOptions {
  readonly onProgress?: (progress: Progress) => void;
  readonly signal?: AbortSignal;
}

/** What runs these kinds of jobs. */
export interface Runs<Known extends JobName> {
  run<K extends Known>(job: K, input: Jobs[K]['takes'], options?: JobOptions): Promise<Jobs[K]['gives']>;
}

const AGAIN = 'Try again; if it stops again, use fewer or smaller files.';

function whenReleased(lock: string, tell: () => void): void {
  // The type says it always exists; a page may lack it all the same.
  const locks = navigator.locks as LockManager | undefined;
  locks?.request(lock, tell).catch(() => undefined);
}

/** A job that failed with its worker; the message is a sentence for the user. */
export class WorkerError extends UserError {
  override readonly name = 'WorkerError';
}

interface Pending {
  readonly onProgress: ((progress: Progress) => void) | undefined;
  readonly parts: ParsedPart[];
  readonly resolve: (output: never) => void;
  readonly reject: (error: Error) => void;
}

export class WorkerClient {
  private worker: WorkerLike | undefined;
  private readonly pending = new Map<number, Pending>();
  private nextId = 1;

  /** @param onReleased calls back when no worker holds that Web Lock any more */
  constructor(
    private readonly spawn: () => WorkerLike,
    private readonly onReleased: (lock: string, tell: () => void) => void = whenReleased,
  ) {}

  /**
   * Runs a job. Rejects with a `WorkerError` if the worker dies or the job fails, or with the signal's reason if it is
   * aborted.
   */
  run<K extends JobName>(
    job: K,
    input: Jobs[K]['takes'],
    { onProgress, signal }: JobOptions = {},
  ): Promise<Jobs[K]['gives']> {
    return new Promise((resolve, reject) => {
      if (signal?.aborted) {
        reject(signal.reason);
        return;
      }
      const id = this.nextId++;
      const cancel = () => {
        this.pending.delete(id);
        reject(signal?.reason);
        this.restart('Cancelled.');
      };
      const settled = () => signal?.removeEventListener('abort', cancel);
      signal?.addEventListener('abort', cancel, { once: true });
      this.pending.set(id, {
        onProgress,
        parts: [],
        // `done` has the output of the requested job: the worker's side is typed by the same table.
        resolve: (output) => {
          settled();
          resolve(output);
        },
        reject: (error) => {
          settled();
          reject(error);
        },
      });
      try {
        // The message is one of the union over `K`; TypeScript can't infer that for a generic K.
        this.alive().postMessage({ id, job, input } as ToWorker);
      } catch (error) {
        this.pending.delete(id);
        settled();
        // Browsers copy what they send, which fails above some 2 GB, or where memory ends.
        reject(new WorkerError(sentenceOf(error)));
      }
    });
  }

  private alive(): WorkerLike {
    if (this.worker) return this.worker;
    const worker = this.spawn();
    worker.onmessage = ({ data }) => {
      if (data.kind === 'alive') {
        // Terminating it releases the lock too.
        this.onReleased(data.lock, () => this.worker === worker && this.restart(`The worker stopped. ${AGAIN}`));
      } else this.receive(data);
    };
    worker.onerror = (event) =>
      this.restart(`The worker stopped: ${event.message || 'it ran out of memory, or could not be loaded'}. ${AGAIN}`);
    worker.onmessageerror = () => this.restart(`The worker sent an unreadable message. ${AGAIN}`);
    this.worker = worker;
    return worker;
  }

  private receive(message: Exclude<FromWorker, { readonly kind: 'alive' }>): void {
    const pending = this.pending.get(message.id);
    if (!pending) return;
    switch (message.kind) {
      case 'progress':
        pending.onProgress?.(message.progress);
        return;
      case 'failed':
        this.pending.delete(message.id);
        pending.reject(new WorkerError(message.message));
        return;
      case 'part':
        pending.parts.push(message.part);
        return;
      case 'done': {
        this.pending.delete(message.id);
        // See `run`: the pending entry was made for this job.
        const resolve = (output: object) => pending.resolve(output as never);
        if (message.job !== 'parse') resolve(message.output);
        else if (!pending.parts.some(({ files }) => files.some(([file]) => isIncomplete(file)))) {
          resolve(whole(message.output, pending.parts));
        } else {
          completed(message.output, pending.parts).then(resolve, (error: unknown) => {
            pending.reject(new WorkerError(sentenceOf(error)));
          });
        }
        return;
      }
    }
  }

  /** Terminates the worker; all other jobs fail with the reason, and the next one gets a new worker. */
  private restart(reason: string): void {
    this.worker?.terminate();
    this.worker = undefined;
    const failed = [...this.pending.values()];
    this.pending.clear();
    for (const { reject } of failed) reject(new WorkerError(reason));
  }
}

function whole(output: ParseOutput, parts: readonly ParsedPart[]): ParseOutput {
  if (parts.length === 0) return output;
  const files = [...output.files];
  for (const part of parts) for (const [file, index] of part.files) files[index] = file;
  return { ...output, files, facts: parts.flatMap(({ facts }) => facts) };
}

/** The same with takes whose channels are made on the page: few files have any, so what makes them is fetched. */
async function completed(output: ParseOutput, parts: readonly ParsedPart[]): Promise<ParseOutput> {
  const { fromMessage } = await import('./settled-takes.ts');
  const { files, ...rest } = whole(output, parts);
  return { ...rest, files: files.map((file) => withCharacters(file, fromMessage)) };
}
