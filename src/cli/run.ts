/** The command as a function: arguments in, exit code out. */
import { UsageError } from './arguments.ts';
import { channels } from './commands/channels.ts';
import { compareCommand } from './commands/compare.ts';
import { convert } from './commands/convert.ts';
import { exportCommand } from './commands/export.ts';
import { grade } from './commands/grade.ts';
import { ik } from './commands/ik.ts';
import { info } from './commands/info.ts';
import { kit } from './commands/kit.ts';
import { pose } from './commands/pose.ts';
import { review } from './commands/review.ts';
import type { CliCommand, CommandIo, ExitCode } from './io.ts';
import { printable, printableLine } from './printable.ts';
import { isOfSystem, reasonOf } from './reason.ts';

const COMMANDS: readonly CliCommand[] = [
  info,
  pose,
  ik,
  channels,
  compareCommand,
  grade,
  kit,
  convert,
  exportCommand,
  review,
];

export async function run(args: readonly string[], given: CommandIo): Promise<ExitCode> {
  const { progress } = given;
  const io: CommandIo = {
    ...given,
    err: (text) => given.err(printable(text)),
    ...(progress && { progress: (line) => progress(printableLine(line)) }),
  };
  const [name, ...rest] = args;
  const command = COMMANDS.find((c) => c.name === name);
  if (name === '--help' || name === '-h' || name === 'help') {
    await io.out(help());
    return 0;
  }
  if (!command) {
    io.err(`marrow: ${name === undefined ? 'no command given.' : `there is no command "${name}".`}\n${help()}`);
    return 2;
  }
  if (beforeDashes(rest).some((arg) => arg === '--help' || arg === '-h')) {
    const details = command.details === undefined ? '' : `\n${command.details}`;
    await io.out(`${usageLine(command)}\n\n${command.summary}\n${details}\nExit codes: ${exitsOf(command)}.\n`);
    return 0;
  }
  try {
    return await command.run(rest, io);
  } catch (error) {
    io.progress?.('');
    if (error instanceof UsageError) {
      io.err(`marrow: ${error.message}\n${usageLine(command)}\n`);
      return 2;
    }
    if (!isOfSystem(error)) throw error;
    const place = error.path === undefined ? '' : `${error.path}: `;
    io.err(`marrow: ${place}${reasonOf(error)}.\n`);
    return 1;
  }
}

function beforeDashes(args: readonly string[]): readonly string[] {
  const end = args.indexOf('--');
  return end < 0 ? args : args.slice(0, end);
}

function usageLine(command: CliCommand): string {
  return `usage: marrow ${command.name} ${command.usage}`;
}

function exitsOf({ exits }: CliCommand): string {
  return Object.entries(exits)
    .map(([code, outcome]) => `${code} ${outcome}`)
    .join(', ');
}

function help(): string {
  const lines = COMMANDS.map((c) => `  marrow ${c.name} ${c.usage}\n      ${c.summary}\n      exits: ${exitsOf(c)}`);
  return `usage:\n${lines.join('\n')}

FILE may be a folder or a zip: all files in it. Options as "--x v" or "--x=v"; values may begin with a minus.
Paths are relative to the caller's folder; angles are radians, times seconds.
Exit code 3 of any command: the standard output could not be written.
`;
}
