/** What keeps the page's main thread busy: its tasks, by the time that the thread itself worked in them. */
import type { CDPSession, Page } from 'playwright-core';

/** A task of the main thread. */
export interface MainThreadTask {
  /**
   * CPU time of the thread. What it waits for is no part of it: other processes that share the cores, and the GPU's,
   * which draws in software here.
   */
  readonly ms: number;
  /** On the clock. */
  readonly wallMs: number;
  /** What took most of it: `FunctionCall` and where, `Layout`, `Receive mojo message`. */
  readonly what: string;
}

/** An event of Chromium's trace; times in µs. */
interface TraceEvent {
  readonly name: string;
  readonly ph: string;
  readonly pid: number;
  readonly tid: number;
  readonly ts: number;
  readonly dur?: number;
  readonly tdur?: number;
  readonly args?: {
    readonly name?: string;
    readonly src_func?: string;
    readonly data?: {
      readonly functionName?: string;
      readonly url?: string;
      readonly lineNumber?: number;
      readonly nodeName?: string;
    };
  };
}

/** Does something, and returns the tasks that it took, longest first. Of all pages that the browser has open. */
export async function tasksOf(page: Page, act: () => Promise<unknown>): Promise<MainThreadTask[]> {
  return tasksIn(await traceOf(page, act));
}

/** Does something, and returns how often the page was laid out and painted meanwhile. */
export async function layoutsOf(page: Page, act: () => Promise<unknown>): Promise<{ layouts: number; paints: number }> {
  const events = await traceOf(page, act);
  const main = mainThreadsIn(events);
  const count = (is: (event: TraceEvent) => boolean) => events.filter((e) => main.has(threadOf(e)) && is(e)).length;
  return {
    layouts: count(({ name, ph }) => name === 'Layout' && (ph === 'B' || ph === 'X')),
    // Each paint tells its document and the parts of it.
    paints: count(({ name, args }) => name === 'Paint' && args?.data?.nodeName === '#document'),
  };
}

async function traceOf(page: Page, act: () => Promise<unknown>): Promise<TraceEvent[]> {
  const browser = page.context().browser();
  if (!browser) throw new Error('The page has no browser of its own.');
  const session = await browser.newBrowserCDPSession();
  const events: TraceEvent[] = [];
  // The trace's own format, which the protocol leaves open.
  session.on('Tracing.dataCollected', ({ value }) => void events.push(...(value as unknown as TraceEvent[])));
  try {
    await session.send('Tracing.start', {
      traceConfig: { includedCategories: ['toplevel', 'devtools.timeline', '__metadata'] },
    });
    await act();
  } finally {
    await endTrace(session);
    await session.detach();
  }
  return events;
}

async function endTrace(session: CDPSession): Promise<void> {
  const complete = new Promise((resolve) => session.once('Tracing.tracingComplete', resolve));
  await session.send('Tracing.end');
  await complete;
}

function mainThreadsIn(events: readonly TraceEvent[]): ReadonlySet<string> {
  return new Set(
    events.filter(({ name, args }) => name === 'thread_name' && args?.name === 'CrRendererMain').map(threadOf),
  );
}

function tasksIn(events: readonly TraceEvent[]): MainThreadTask[] {
  const main = mainThreadsIn(events);
  const timed = events.filter((event) => event.tdur !== undefined && event.ph === 'X' && main.has(threadOf(event)));
  const isTask = ({ name }: TraceEvent) => name === 'ThreadControllerImpl::RunTask';
  return timed
    .filter(isTask)
    .map((task) => ({ ms: (task.tdur ?? 0) / 1000, wallMs: (task.dur ?? 0) / 1000, task }))
    .sort((a, b) => b.ms - a.ms)
    .slice(0, 20)
    .map(({ ms, wallMs, task }) => {
      const inside = timed.filter(
        (event) =>
          !isTask(event) &&
          threadOf(event) === threadOf(task) &&
          event.ts >= task.ts &&
          event.ts < task.ts + (task.dur ?? 0) &&
          (event.tdur ?? 0) > 0.3 * (task.tdur ?? 0),
      );
      return { ms, wallMs, what: [task, ...inside].map(describe).join(' > ') };
    });
}

const threadOf = ({ pid, tid }: TraceEvent) => `${pid}/${tid}`;

function describe({ name, args, tdur }: TraceEvent): string {
  const { functionName, url, lineNumber } = args?.data ?? {};
  const where = functionName ?? args?.src_func ?? '';
  const file = url?.split('/').at(-1) ?? '';
  return `${name} ${where} ${file}${lineNumber === undefined ? '' : `:${lineNumber}`} ${Math.round((tdur ?? 0) / 1000)}`;
}
