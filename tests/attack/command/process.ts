/** The built command as a process: limits, closed streams, signals; and what a process may not do, however it ends. */
import { type StdioOptions, spawn } from 'node:child_process';
import { closeSync, existsSync, openSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const BUILT = fileURLToPath(new URL('../../../build/marrow.js', import.meta.url));
/** Longer is a hang. */
const LIMIT_MS = 60_000;
/** All tries are small; V8 alone takes a tenth of it. */
const MAX_MEMORY_MB = 1200;
/** Writes the most memory that the process had, in kB, to the fourth stream. */
const TELL_MEMORY =
  "import{writeSync}from'node:fs';import{isMainThread}from'node:worker_threads';if(isMainThread)process.on('exit',()=>{try{writeSync(3,String(process.resourceUsage().maxRSS))}catch{}})";

export interface Ended {
  /** Absent: ended by a signal. */
  readonly code?: number;
  readonly out: string;
  readonly err: string;
  readonly ms: number;
  /** 0 if it was killed. */
  readonly memoryMb: number;
  readonly isHung: boolean;
}

export interface Limits {
  /** What runs before it: `prlimit --fsize=1000`. */
  readonly prefix?: readonly string[];
  /** A file or device for the standard output; default: a pipe that is read. */
  readonly stdout?: string;
  /** Ends the process after so many milliseconds. */
  readonly kill?: { readonly afterMs: number; readonly signal: NodeJS.Signals };
}

/** @throws Error if the command was not built */
export function marrow(
  args: readonly string[],
  folder: string,
  { prefix = [], stdout, kill }: Limits = {},
): Promise<Ended> {
  if (!existsSync(BUILT)) throw new Error('build/marrow.js is not there: "npm run build" first.');
  const [program, ...rest] = [
    ...prefix,
    process.execPath,
    `--import=data:text/javascript,${encodeURIComponent(TELL_MEMORY)}`,
    BUILT,
    ...args,
  ];
  const out = stdout === undefined ? undefined : openSync(stdout, 'w');
  const stdio: StdioOptions = ['ignore', out ?? 'pipe', 'pipe', 'pipe'];
  return new Promise((resolve, reject) => {
    const begun = performance.now();
    const child = spawn(program, rest, { cwd: folder, stdio });
    const texts = ['', '', '', ''];
    let isHung = false;
    for (const i of [1, 2, 3]) {
      child.stdio[i]?.on('data', (part) => {
        texts[i] += part;
      });
    }
    const limit = setTimeout(() => {
      isHung = true;
      child.kill('SIGKILL');
    }, LIMIT_MS);
    const killing = kill && setTimeout(() => child.kill(kill.signal), kill.afterMs);
    const done = () => {
      clearTimeout(limit);
      clearTimeout(killing);
      if (out !== undefined) closeSync(out);
    };
    child.on('error', (error) => {
      done();
      reject(error);
    });
    child.on('close', (code) => {
      done();
      const [, text, err, memory] = texts;
      const ms = performance.now() - begun;
      resolve({ ...(code !== null && { code }), out: text, err, ms, memoryMb: Number(memory) / 1024, isHung });
    });
  });
}

/** What is known of how it ended; in this process, less. */
export type End = Pick<Ended, 'err'> & Partial<Ended>;

/** What is wrong about how it ended; empty if nothing is. */
export function faultsOf({ code, err, out = '', isHung = false, memoryMb = 0 }: End): string[] {
  const faults: string[] = [];
  // That something differs is a result.
  const words = code === 1 ? err + out : err;
  if (isHung) faults.push(`it took longer than ${LIMIT_MS / 1000} s`);
  if (memoryMb > MAX_MEMORY_MB) faults.push(`it took ${Math.round(memoryMb)} MB`);
  if (code !== undefined && ![0, 1, 2, 3].includes(code)) faults.push(`it ended with ${code}`);
  if (code !== undefined && code !== 0 && words.trim() === '') faults.push(`it ended with ${code} without a word`);
  if (/^\s+at .+:\d+:\d+\)?$/m.test(err) || /node:internal|\bnode:fs\b/.test(err)) faults.push('it told a stack trace');
  if (/\b(E[A-Z]{3,12}|ERR_[A-Z_]+)\b[:,]/.test(err)) faults.push('it told an error code for a sentence');
  if (/\b(TypeError|RangeError|undefined|\[object Object\])\b/.test(err))
    faults.push("it told an error of the program's own");
  if (/[^\P{Cc}\n\t]/u.test(err)) faults.push('control characters reached the terminal');
  return faults;
}
