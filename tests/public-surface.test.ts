/**
 * Everything that the core exports has a doc comment: functions, classes with their public methods, types, constants.
 * Only a block that ends on the line above counts, since editors and API pages show no other. The first declaration of
 * overloads speaks for all of them, and one of two accessors for both.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { type ESTree, parseSync } from 'vite';
import { expect, test } from 'vitest';

const SRC = fileURLToPath(new URL('../src/', import.meta.url));

const FOLDERS = [
  'math',
  'model',
  'formats',
  'evaluate',
  'edit',
  'dataset',
  'teaching',
  'import',
  'export',
  'files',
  'package',
];

/** A declaration that callers see. */
interface Exported {
  /** That of a method has its class before it: `Store.apply`. */
  readonly name: string;
  /** Offset of the declaration in its file, that of `export` where it has one. */
  readonly start: number;
}

function nameOf(node: { readonly type: string; readonly name?: unknown; readonly value?: unknown }): string {
  return String(node.type === 'Literal' ? node.value : node.name);
}

/** Public methods and accessors, besides constructors, which their class describes, and what overrides another's. */
function methodsOf(owner: string, body: ESTree.ClassBody): Exported[] {
  return body.body.flatMap((member) => {
    const isMethod = member.type === 'MethodDefinition' || member.type === 'TSAbstractMethodDefinition';
    if (!isMethod || member.kind === 'constructor' || member.override) return [];
    const isHidden = member.accessibility === 'private' || member.accessibility === 'protected';
    if (isHidden || member.key.type === 'PrivateIdentifier') return [];
    return [{ name: `${owner}.${nameOf(member.key)}`, start: member.start }];
  });
}

function exportsIn(text: string, file: string): Exported[] {
  const found = parseSync(file, text).program.body.flatMap((statement): Exported[] => {
    if (statement.type !== 'ExportNamedDeclaration' || !statement.declaration) return [];
    const { declaration, start } = statement;
    switch (declaration.type) {
      case 'VariableDeclaration':
        return declaration.declarations.map(({ id }) => ({ name: nameOf(id), start }));
      case 'ClassDeclaration': {
        const name = declaration.id?.name ?? '';
        return [{ name, start }, ...methodsOf(name, declaration.body)];
      }
      default:
        return [{ name: 'id' in declaration && declaration.id ? nameOf(declaration.id) : '', start }];
    }
  });
  // The first of overloads and of two accessors.
  return found.filter(({ name }, i) => found.findIndex((one) => one.name === name) === i);
}

/** A tag alone doesn't say what a function gives, and nothing is above a comment on the page of an API. */
const WITHOUT_SUBJECT = /^\/\*\*[\s*]*(?:@|(?:Of|What|The same) )/;

function isDocumented(text: string, start: number): boolean {
  const above = text.lastIndexOf('\n', start);
  if (above < 0 || text.slice(above, start).trim() || !text.endsWith('*/', above)) return false;
  const comment = text.slice(text.lastIndexOf('/*', above), above);
  return comment.startsWith('/**') && !WITHOUT_SUBJECT.test(comment);
}

/** Undocumented exports as `file:line name`. */
function undocumentedIn(folder: string): string[] {
  const files = readdirSync(join(SRC, folder), { recursive: true, encoding: 'utf8' });
  return files
    .map((file) => `${folder}/${file.replaceAll('\\', '/')}`)
    .filter((file) => /(?<!\.d)\.ts$/.test(file))
    .sort()
    .flatMap((file) => {
      const text = readFileSync(join(SRC, file), 'utf8');
      return exportsIn(text, file)
        .filter(({ start }) => !isDocumented(text, start))
        .map(({ name, start }) => `${file}:${text.slice(0, start).split('\n').length} ${name}`);
    });
}

test.each(FOLDERS)('everything that %s exports has a doc comment', (folder) => {
  expect(undocumentedIn(folder)).toEqual([]);
});
