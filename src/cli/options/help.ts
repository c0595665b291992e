/** Usage and help of commands, made from their records. */
import { written } from './parse.ts';
import type { ShellCommand } from './shell-command.ts';

/** A part of a command's help, for any layout. `Code` in texts is between backticks. */
export type HelpPart =
  | { readonly text: string }
  | { readonly heading: string | undefined; readonly terms: readonly (readonly [term: string, what: string])[] }
  | { readonly examples: readonly string[] };

/** Ways to write it, with the options that can't be left out: `marrow grade CLASS --reference REF [options]`. */
export function usageLines({ name, inputs, options }: ShellCommand): readonly string[] {
  const required = Object.entries(options).flatMap(([each, option]) =>
    option.isRequired ? [written(each, option)] : [],
  );
  return inputs.forms.map((form) => ['marrow', name, form, ...required, '[options]'].join(' '));
}

/** All that is said about a command besides its usage and its exit codes. */
export function helpParts(command: ShellCommand): readonly HelpPart[] {
  const { summary, inputs, options, about = [], examples } = command;
  const sections = new Map<string, (readonly [string, string])[]>();
  for (const [name, option] of Object.entries(options)) {
    const { section = 'Options' } = option;
    sections.set(section, [...(sections.get(section) ?? []), [written(name, option), explained(name, command)]]);
  }
  return [
    { text: summary },
    { heading: undefined, terms: Object.entries(inputs.terms) },
    ...about.map((each): HelpPart => {
      return typeof each === 'string' ? { text: each } : { heading: each.heading, terms: Object.entries(each.terms) };
    }),
    ...[...sections].map(([heading, terms]): HelpPart => ({ heading, terms })),
    ...(examples ? [{ examples }] : []),
  ];
}

/** What an option does, and what is to be known when it is given. */
function explained(name: string, { options, exclusive }: ShellCommand): string {
  const { what, default: otherwise, isRequired, isRepeated, needs } = options[name];
  const excluded = exclusive.filter((names) => names.includes(name)).flat();
  const others = excluded.filter((each) => each !== name).map((each) => `\`--${each}\``);
  return [
    what,
    ...(otherwise === undefined ? [] : [`Default: ${otherwise}.`]),
    ...(isRequired ? ['Required.'] : []),
    ...(isRepeated ? ['May be given several times.'] : []),
    ...(needs === undefined || options[needs].isRequired ? [] : [`Needs \`--${needs}\`.`]),
    ...(others.length > 0 ? [`Not with ${others.join(' or ')}.`] : []),
  ].join(' ');
}

/** `0 all agree, 1 numbers differ, 2 wrong usage` */
export function exitsText({ exits }: ShellCommand): string {
  return Object.entries(exits)
    .map(([code, outcome]) => `${code} ${outcome}`)
    .join(', ');
}

/** The usage, in as many lines as there are ways to write it. */
export function usageText(command: ShellCommand): string {
  return `usage: ${usageLines(command).join('\n       ')}`;
}

/** Columns of help. */
const WIDTH = 100;
/** Explanations begin in this column; longer terms have a line of their own. */
const INDENT = 25;

/** What `--help` prints. */
export function helpText(command: ShellCommand): string {
  const parts = helpParts(command).map((part) => {
    if ('text' in part) return wrapped(plain(part.text), 0);
    if ('examples' in part) return ['Examples', ...part.examples.map((example) => `  ${example}`)].join('\n');
    const { heading, terms } = part;
    return [...(heading === undefined ? [] : [heading]), ...terms.map(([term, what]) => termText(term, what))].join(
      '\n',
    );
  });
  return `${[usageText(command), ...parts].join('\n\n')}\n\nExit codes: ${exitsText(command)}.\n`;
}

function termText(term: string, what: string): string {
  const start = `  ${term}`.padEnd(INDENT);
  const lines = wrapped(plain(what), INDENT);
  return start.length > INDENT || !start.endsWith(' ') ? `${start}\n${lines}` : start + lines.slice(INDENT);
}

function plain(text: string): string {
  return text.replaceAll('`', '');
}

/** Lines of at most `WIDTH` columns, each with an indent. */
function wrapped(text: string, indent: number): string {
  const lines: string[] = [];
  let line = '';
  for (const word of text.split(' ')) {
    if (line !== '' && indent + line.length + 1 + word.length > WIDTH) {
      lines.push(line);
      line = '';
    }
    line += line === '' ? word : ` ${word}`;
  }
  return [...lines, line].map((each) => ' '.repeat(indent) + each).join('\n');
}
