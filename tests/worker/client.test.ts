import { describe, expect, it } from 'vitest';
import { WorkerClient, WorkerError, type WorkerLike } from '../../src/worker/client.ts';
import type { FromWorker, ParseOutput, ToWorker } from '../../src/worker/protocol.ts';

/** A worker without a thread: the test says what it answers. */
class StandIn implements WorkerLike {
  onmessage: WorkerLike['onmessage'] = null;
  onerror: WorkerLike['onerror'] = null;
  onmessageerror: WorkerLike['onmessageerror'] = null;
  readonly posted: ToWorker[] = [];
  terminated = false;

  postMessage(message: ToWorker): void {
    this.posted.push(message);
  }

  terminate(): void {
    this.terminated = true;
  }

  answer(message: FromWorker): void {
    this.onmessage?.(new MessageEvent('message', { data: message }));
  }

  crash(): void {
    // Node has no ErrorEvent; the client reads nothing of it but the message.
    this.onerror?.(Object.assign(new Event('error'), { message: 'out of memory' }) as ErrorEvent);
  }
}

const nothing: ParseOutput = { files: [], broken: [], diagnostics: [], facts: [], keeps: [] };

function client() {
  const workers: StandIn[] = [];
  const released = new Map<string, () => void>();
  const made = new WorkerClient(
    () => {
      const worker = new StandIn();
      workers.push(worker);
      return worker;
    },
    (lock, tell) => released.set(lock, tell),
  );
  return { made, workers, released };
}

describe('WorkerClient', () => {
  it('starts its worker at the first job, and keeps it', async () => {
    const { made, workers } = client();
    expect(workers).toHaveLength(0);
    const first = made.run('parse', { files: [] });
    const second = made.run('parse', { files: [] });
    expect(workers).toHaveLength(1);
    const [a, b] = workers[0].posted;
    const other = { ...nothing, diagnostics: [] };
    workers[0].answer({ id: b.id, kind: 'done', job: 'parse', output: other });
    workers[0].answer({ id: a.id, kind: 'done', job: 'parse', output: nothing });
    expect(await first).toBe(nothing);
    expect(await second).toBe(other);
  });

  it('WorkerClient passes progress on', async () => {
    const { made, workers } = client();
    const seen: number[] = [];
    const job = made.run('parse', { files: [] }, { onProgress: (p) => seen.push(p.done) });
    const { id } = workers[0].posted[0];
    workers[0].answer({ id, kind: 'progress', progress: { label: 'a', done: 5, of: 9 } });
    workers[0].answer({ id, kind: 'done', job: 'parse', output: nothing });
    await job;
    expect(seen).toEqual([5]);
  });

  it('WorkerClient turns a failed job into an error with its sentence', async () => {
    const { made, workers } = client();
    const job = made.run('parse', { files: [] });
    workers[0].answer({ id: workers[0].posted[0].id, kind: 'failed', message: 'no room' });
    await expect(job).rejects.toEqual(new WorkerError('no room'));
  });

  it('ends the worker when a job is cancelled, and starts another for the next', async () => {
    const { made, workers } = client();
    const abort = new AbortController();
    const job = made.run('parse', { files: [] }, { signal: abort.signal });
    abort.abort(new Error('cancelled'));
    await expect(job).rejects.toThrow('cancelled');
    expect(workers[0].terminated).toBe(true);
    const next = made.run('parse', { files: [] });
    workers[1].answer({ id: workers[1].posted[0].id, kind: 'done', job: 'parse', output: nothing });
    expect(await next).toBe(nothing);
  });

  it('says so when the worker dies, and works again afterwards', async () => {
    const { made, workers } = client();
    const job = made.run('parse', { files: [] });
    workers[0].crash();
    await expect(job).rejects.toThrow('out of memory');
    made.run('parse', { files: [] });
    expect(workers).toHaveLength(2);
  });

  it('notices that the browser ended the worker, which tells nobody, and works again afterwards', async () => {
    const { made, workers, released } = client();
    const job = made.run('parse', { files: [] });
    workers[0].answer({ kind: 'alive', lock: 'a' });
    released.get('a')?.();
    await expect(job).rejects.toThrow('The worker stopped. Try again');
    const next = made.run('parse', { files: [] });
    expect(workers).toHaveLength(2);
    // That of the first says nothing of the second.
    released.get('a')?.();
    workers[1].answer({ id: workers[1].posted[0].id, kind: 'done', job: 'parse', output: nothing });
    await expect(next).resolves.toBe(nothing);
  });

  it('says in its own words that a browser can’t pass the work on, and works again afterwards', async () => {
    const { made, workers } = client();
    const before = made.run('parse', { files: [] });
    const { postMessage } = workers[0];
    workers[0].postMessage = () => {
      throw new DOMException(
        "Failed to execute 'postMessage' on 'Worker': Data cannot be cloned, out of memory.",
        'DataCloneError',
      );
    };
    await expect(made.run('parse', { files: [] })).rejects.toThrow(/^There is not enough memory for this\./);
    workers[0].postMessage = postMessage;
    workers[0].answer({ id: workers[0].posted[0].id, kind: 'done', job: 'parse', output: nothing });
    expect(await before).toBe(nothing);
  });

  it('WorkerClient does not begin what was cancelled before', async () => {
    const { made, workers } = client();
    await expect(
      made.run('parse', { files: [] }, { signal: AbortSignal.abort(new Error('too late')) }),
    ).rejects.toThrow('too late');
    expect(workers).toHaveLength(0);
  });
});
