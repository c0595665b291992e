#!/usr/bin/env node
/**
 * The command's entry: wires `run` to the process. Sets `exitCode` instead of calling `process.exit`, which would cut
 * off output still buffered for a pipe.
 */
import { text } from 'node:stream/consumers';
import { exportWork } from './export/one-take.ts';
import { gradeWork } from './grade/threads.ts';
import { callersFolder } from './paths.ts';
import { run } from './run.ts';
import { worksInThread } from './threads.ts';

// A pipe closed by its reader (`| head`) is no error.
let closed = false;
for (const stream of [process.stdout, process.stderr]) {
  stream.on('error', (error: NodeJS.ErrnoException) => {
    if (error.code !== 'EPIPE') throw error;
    closed = true;
  });
}

function write(text: string): Promise<void> {
  return new Promise((resolve) => {
    if (closed) resolve();
    else process.stdout.write(text, () => resolve());
  });
}

// Classes are judged, and takes exported, by several threads that run this very program.
if (!worksInThread({ grade: gradeWork, export: exportWork })) {
  process.exitCode = await run(process.argv.slice(2), {
    folder: callersFolder('marrow'),
    out: write,
    err: (text) => void (closed || process.stderr.write(text)),
    ...(process.stderr.isTTY && { progress: (line) => void (closed || process.stderr.write(`\r\x1b[K${line}`)) }),
    input: () => text(process.stdin),
    program: new URL(import.meta.url),
  });
}
