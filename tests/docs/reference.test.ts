/**
 * The reference pages that are made from the code: shortcuts, the command, what scripts can run, and what the package
 * exports. A test fails if one is out of date, so that no public name changes unsaid; `npm run docs` writes them.
 */
import { expect, it } from 'vitest';
import packageJson from '../../package.json' with { type: 'json' };
import { type HelpPart, helpParts, usageLines } from '../../src/cli/options/help.ts';
import type { ShellCommand } from '../../src/cli/options/shell-command.ts';
import { COMMANDS } from '../../src/cli/run.ts';
import { commandList } from '../../src/edit/commands/all.ts';
import { ESSENTIALS } from '../../src/ui/shell/help/essential-shortcuts.ts';
import { MOUSE_GESTURES } from '../../src/ui/shell/help/mouse-gestures.ts';
import { actionLabel, actionsOf } from '../../src/ui/state/actions/action.ts';
import { GROUPS } from '../../src/ui/state/menus.ts';
import { shortcutText } from '../../src/ui/state/shortcuts.ts';
import type { Action } from '../../src/ui/state/workbench.ts';
import { entryComment, type PublicName, publicNames } from '../helpers/public-names.ts';
import { workbench } from '../ui/builders.ts';

const MADE = '<!-- Made from the code by `npm run docs`. -->';
const page = (name: string) => `../../docs/reference/${name}.md`;

it('the page of shortcuts has every action with a key, and every gesture of the mouse', async () => {
  await expect(shortcuts()).toMatchFileSnapshot(page('shortcuts'));
});

it('the page of the command has what its help says', async () => {
  await expect(commandPage()).toMatchFileSnapshot(page('command'));
});

it('the page of script commands has the arguments of each', async () => {
  await expect(scriptCommands()).toMatchFileSnapshot(page('script-commands'));
});

it('the page of the package has every public name, with what it takes and gives', async () => {
  await expect(packagePage()).toMatchFileSnapshot(page('package'));
});

/** Text in a cell of a table. */
const cell = (text: string) => text.replaceAll('|', '\\|');
const table = (head: readonly string[], rows: readonly (readonly string[])[]) =>
  [head, head.map(() => '---'), ...rows].map((row) => `| ${row.map(cell).join(' | ')} |`).join('\n');

function shortcuts(): string {
  const { wb } = workbench();
  const actions = actionsOf(wb).filter((action) => action.shortcuts?.length);
  const keysOf = ({ shortcuts = [] }: Pick<Action, 'shortcuts'>) =>
    shortcuts.map((key) => `\`${shortcutText(key, false)}\``).join(' ');
  const labelOf = (action: Action) => action.name ?? actionLabel(wb, action);
  const sections = GROUPS.flatMap((group) => {
    const own = actions.filter((action) => action.group === group);
    const places = [...new Set([undefined, ...own.map(({ panel }) => panel)])];
    const tables = places.flatMap((panel) => {
      const held = own.filter((action) => action.panel === panel);
      const head = panel === undefined ? [group, 'keys'] : [`${group}, with the focus in the ${panel}`, 'keys'];
      return held.length > 0
        ? [
            table(
              head,
              held.map((action) => [labelOf(action), keysOf(action)]),
            ),
          ]
        : [];
    });
    return tables.length > 0 ? [`## ${group}\n\n${tables.join('\n\n')}`] : [];
  });
  const firstKey = (id: string) =>
    keysOf(actions.find((action) => action.id === id) ?? { shortcuts: [] }).split(' ')[0];
  const essentials = ESSENTIALS.map(({ where, lines }) => {
    const rows = lines.map(({ what, ids = [], how }) => [what, how ?? ids.map(firstKey).join(' ')]);
    return table([where, 'keys'], rows);
  });
  const mouse = MOUSE_GESTURES.map(({ where, lines }) => `### ${where}\n\n${table(['to', 'do'], lines)}`);
  return `${MADE}

# Shortcuts

\`?\` shows this page in Marrow, where single keys can be changed or switched off. On a Mac, Ctrl is ⌘ and Alt is ⌥.

## Essentials

${essentials.join('\n\n')}

${sections.join('\n\n')}

## Mouse and touch

${mouse.join('\n\n')}
`;
}

/** Part of a command's page; tables have the terms of its help. */
function partText(part: HelpPart): string {
  if ('text' in part) return part.text;
  if ('examples' in part) return `\`\`\`sh\n${part.examples.join('\n')}\n\`\`\``;
  const { heading = 'Input', terms } = part;
  return table(
    [heading, 'Meaning'],
    terms.map(([term, what]) => [`\`${term}\``, what]),
  );
}

function commandSection(shellCommand: ShellCommand): string {
  const { name, exits } = shellCommand;
  return [
    `## ${name}`,
    `\`\`\`text\n${usageLines(shellCommand).join('\n')}\n\`\`\``,
    ...helpParts(shellCommand).map(partText),
    table(
      ['Exit code', 'Meaning'],
      Object.entries(exits).map(([code, outcome]) => [code, outcome]),
    ),
  ].join('\n\n');
}

function commandPage(): string {
  return `${MADE}

# The \`marrow\` command

What the page does with files, without a page: for scripts, tests and folders of takes. After \`npm run build\` it is
\`build/marrow.js\`, which needs nothing but Node; \`npm run -s marrow -- info wasp.skel\` runs it from a checkout.

With \`--json\` it prints JSON: angles in radians, times in seconds, matrices column-major, everything in double precision.
Files are named by their paths everywhere. Outputs are either complete or untouched, even on a full disk or after a kill.
A pipe of up to 256 MB works in place of a file: \`marrow compare wasp.skel <(./mine)\`.

\`marrow COMMAND --help\` explains the options, as this page does. Write them as \`--x v\` or \`--x=v\`; values may start with
a minus, and everything after \`--\` is a file. A folder or a zip means all files in it. Exit code 3, any command:
standard output could not be written.

${COMMANDS.map(commandSection).join('\n\n')}
`;
}

function scriptCommands(): string {
  const lines = commandList().map(({ id, arguments: given }) => {
    // How long a text may be says nothing to a reader.
    const all = Object.entries(given).map(
      ([name, what]) => `\`${name}\`: ${what.replaceAll(/text of up to [\d,]+ characters/g, 'text')}`,
    );
    return [`\`${id}\``, all.join('; ')] as const;
  });
  return `${MADE}

# Script commands

What \`marrow.run(id, arguments)\` runs in the [console](scripting.md), each one undo step. \`marrow.commands()\` prints the same.

${table(['id', 'arguments'], lines)}
`;
}

/** The entries, as `exports` has them. */
const ENTRIES = Object.keys(packageJson.exports).flatMap((path) => /^\.\/(\w+)$/.exec(path)?.[1] ?? []);

/** The first sentence or the first few, of what is told before parameters. */
const lead = (comment: string) => comment.split(/\n\n|\n(?= *@)/)[0].replaceAll('\n', ' ');

/** Markdown of a comment: its code is indented already; tags become lists. */
function commentText(comment: string): string {
  const [text, ...tags] = comment.split(/(?:^|\s)(?=@(?:param|returns|throws)\b)/);
  const lines = tags.map((tag) =>
    tag
      .replaceAll(/\s+/g, ' ')
      .replace(/^@param (\S+) /, '- `$1`: ')
      .replace(/^@returns /, '- returns ')
      .replace(/^@throws (\S+) /, '- throws `$1` ')
      .trim(),
  );
  return [text.trim(), ...(lines.length > 0 ? [lines.join('\n')] : [])].filter(Boolean).join('\n\n');
}

/** The comment at the top, with its code as a block. */
function entryText(entry: string): string {
  const [first = '', ...rest] = entryComment(entry)
    .replace(/^`marrow\/\w+`: /, '')
    .split('\n\n');
  const text = first.charAt(0).toUpperCase() + first.slice(1);
  const isCode = (part: string) => part.startsWith('    ');
  return [
    text,
    ...rest.map((part) => (isCode(part) ? `\`\`\`js\n${part.replaceAll(/^ {4}/gm, '')}\n\`\`\`` : part)),
  ].join('\n\n');
}

function entrySection(entry: string): string {
  const names = publicNames(entry);
  const value = ({ name, signature, comment }: PublicName) =>
    `### ${name}\n\n\`\`\`ts\n${signature}\n\`\`\`\n\n${commentText(comment)}`;
  const types = names
    .filter(({ isType }) => isType)
    .map(({ name, comment }) => [`\`${name}\``, lead(comment)] as const);
  return [
    `## marrow/${entry}`,
    entryText(entry),
    ...names.filter(({ isType }) => !isType).map(value),
    table([`Types of marrow/${entry}`, 'Meaning'], types),
  ].join('\n\n');
}

function packagePage(): string {
  return `${MADE}

# The package

The core of Marrow for programs of your own, in Node and in pages: ES modules with types, and no dependencies.
[Programs](../guide/programs.md) says how to install it, with examples. These names are all that is public; others in its
files may change at any time.

${ENTRIES.map(entrySection).join('\n\n')}
`;
}
