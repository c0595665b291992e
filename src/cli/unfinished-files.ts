/**
 * Unfinished files: `walk.npz.1f3a09bc-4711-0a1b2c3d.tmp`, with the machine and the process that write it, until they
 * are renamed. What a killed process leaves is removed by the next one that writes to the folder.
 */
import { createHash, randomBytes } from 'node:crypto';
import { readdirSync, rmSync } from 'node:fs';
import { hostname } from 'node:os';
import { basename, join } from 'node:path';
import { isMainThread } from 'node:worker_threads';
import { isOfSystem } from './reason.ts';

/** Folders are shared by machines, whose processes are not known here. */
const MACHINE = createHash('sha256').update(hostname()).digest('hex').slice(0, 8);
const STALE = new RegExp(`\\.${MACHINE}-(\\d+)-[0-9a-f]{8}\\.tmp$`);
/** File systems allow 255 bytes. */
const MAX_NAME_BYTES = 200;

/** Absolute; of this process alone. @param path of the finished file */
export function unfinishedName(path: string, folder: string): string {
  const name = Buffer.from(basename(path)).subarray(0, MAX_NAME_BYTES).toString();
  return join(folder, `${name}.${MACHINE}-${process.pid}-${randomBytes(4).toString('hex')}.tmp`);
}

const tidied = new Set<string>();

/** Removes what ended processes of this machine left in the folder; once for each folder. */
export function removeStale(folder: string): void {
  if (tidied.has(folder)) return;
  tidied.add(folder);
  for (const name of readdirSync(folder)) {
    const pid = STALE.exec(name)?.[1];
    if (pid !== undefined && !runs(Number(pid))) rmSync(join(folder, name), { force: true });
  }
}

function runs(pid: number): boolean {
  try {
    return process.kill(pid, 0);
  } catch (error) {
    // Another user's may not be asked, but is there.
    return isOfSystem(error) && error.code === 'EPERM';
  }
}

const SIGNALS = ['SIGINT', 'SIGTERM', 'SIGHUP'] as const;
let isHolding = false;

/** Until the next turn of the loop signals wait, so that they don't leave an unfinished file. */
export function holdSignals(): void {
  // Threads hear none; their process ends them, and unfinished files are in a folder of the run.
  if (!isMainThread || isHolding) return;
  isHolding = true;
  const end = (signal: NodeJS.Signals) => {
    release();
    process.kill(process.pid, signal);
  };
  const release = () => {
    for (const signal of SIGNALS) process.off(signal, end);
    isHolding = false;
  };
  for (const signal of SIGNALS) process.on(signal, end);
  setImmediate(release);
}
