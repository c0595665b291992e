#!/usr/bin/env node
/**
 * The command's entry: wires `run` to the process. Sets `exitCode` instead of calling `process.exit`, which would cut
 * off output still buffered for a pipe.
 */
import { text } from 'node:stream/consumers';
import { exportWork } from './export/one-take.ts';
import { gradeWork } from './grade/threads.ts';
import type { ExitCode } from './io.ts';
import { callersFolder } from './paths.ts';
import { printable } from './printable.ts';
import { reasonOf } from './reason.ts';
import { run } from './run.ts';
import { worksInThread } from './threads.ts';

/** Of both streams, since what writes into a pipe can't know which of them its reader closed. */
let closed = false;
/** Results that could not be written: why. */
let unwritten: string | undefined;
process.stdout.on('error', (error: NodeJS.ErrnoException) => {
  // A pipe closed by its reader (`| head`) is no error.
  if (error.code !== 'EPIPE') unwritten = reasonOf(error);
  closed = true;
});
process.stderr.on('error', () => {
  // Nobody is left to be told.
});

function write(text: string): Promise<void> {
  return new Promise((resolve) => {
    if (closed) resolve();
    // Files and pipes get exact bytes.
    else process.stdout.write(process.stdout.isTTY ? printable(text) : text, () => resolve());
  });
}

function tell(text: string): void {
  process.stderr.write(text);
}

// Classes are judged, and takes exported, by several threads that run this very program.
if (!worksInThread({ grade: gradeWork, export: exportWork })) {
  const code = await run(process.argv.slice(2), {
    folder: callersFolder('marrow'),
    out: write,
    err: tell,
    ...(process.stderr.isTTY && { progress: (line) => tell(`\r\x1b[K${line}`) }),
    input: () => text(process.stdin),
    program: new URL(import.meta.url),
  }).catch((error): ExitCode => {
    tell(`marrow: internal error, please report it: ${printable(reasonOf(error))}\n`);
    return 1;
  });
  if (unwritten !== undefined) tell(`marrow: the results could not be written: ${unwritten}.\n`);
  process.exitCode = unwritten === undefined ? code : 3;
}
