/** The command as a function: arguments in, exit code out. */
import { channels } from './commands/channels.ts';
import { compareCommand } from './commands/compare.ts';
import { convert } from './commands/convert.ts';
import { exportCommand } from './commands/export.ts';
import { grade } from './commands/grade.ts';
import { ik } from './commands/ik.ts';
import { info } from './commands/info.ts';
import { kit } from './commands/kit.ts';
import { page } from './commands/page.ts';
import { pose } from './commands/pose.ts';
import { review } from './commands/review.ts';
import type { CommandIo, ExitCode } from './io.ts';
import { exitsText, helpText, usageLines, usageText } from './options/help.ts';
import { nearestName } from './options/nearest-name.ts';
import type { ShellCommand } from './options/shell-command.ts';
import { printable, printableLine } from './printable.ts';
import { isOfSystem, reasonOf } from './reason.ts';
import { UsageError } from './usage-error.ts';

/** All subcommands, in the order of the help. */
export const COMMANDS: readonly ShellCommand[] = [
  info,
  pose,
  ik,
  channels,
  compareCommand,
  grade,
  kit,
  convert,
  exportCommand,
  page,
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
    io.err(`marrow: ${name === undefined ? 'no command given.' : unknownCommand(name)}\n${help()}`);
    return 2;
  }
  if (beforeDashes(rest).some((arg) => arg === '--help' || arg === '-h')) {
    await io.out(helpText(command));
    return 0;
  }
  try {
    return await command.run(rest, io);
  } catch (error) {
    io.progress?.('');
    if (error instanceof UsageError) {
      io.err(`marrow: ${error.message}\n${usageText(command)}\nOptions: marrow ${command.name} --help\n`);
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

function unknownCommand(name: string): string {
  const nearest = nearestName(
    name,
    COMMANDS.map((command) => command.name),
  );
  const hint = nearest === undefined ? '' : ` Did you mean "${nearest}"?`;
  return `there is no command "${name}".${hint}`;
}

function help(): string {
  const lines = COMMANDS.map((command) => {
    const usage = usageLines(command).map((line) => `  ${line}\n`);
    return `${usage.join('')}      ${command.summary}\n      exits: ${exitsText(command)}`;
  });
  return `usage:
${lines.join('\n')}

${COMMON_HELP.join('\n')}
`;
}

/** True of all commands. */
const COMMON_HELP: readonly string[] = [
  'marrow COMMAND --help explains the options of a command. FILE may be a folder or a zip, meaning all files in it.',
  'Write options as "--x v" or "--x=v"; values may start with a minus, and everything after "--" is a file.',
  'Paths are relative to the current folder. Angles are in radians, times in seconds.',
  'Exit code 3, any command: standard output could not be written.',
];
