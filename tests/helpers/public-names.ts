/** What the entries of the npm package export, with what the sources say of it. */
import { readFileSync } from 'node:fs';
import { posix } from 'node:path';
import { fileURLToPath } from 'node:url';
import { type ESTree, parseSync } from 'vite';

const SRC = fileURLToPath(new URL('../../src/', import.meta.url));

/** A public name of an entry. */
export interface PublicName {
  readonly name: string;
  readonly isType: boolean;
  /** Of a function, up to its body: `poseAt(character: Character): Float64Array`; of a type, all of it. */
  readonly signature: string;
  /** Without the marks of comments. */
  readonly comment: string;
}

/** The names in alphabetical order. @param entry `formats` for `marrow/formats` */
export function publicNames(entry: string): readonly PublicName[] {
  return namesIn(`package/${entry}.ts`).toSorted((a, b) => (a.name < b.name ? -1 : 1));
}

/** The comment at the top of an entry. */
export function entryComment(entry: string): string {
  return plain(/^\/\*\*.*?\*\//s.exec(readFileSync(`${SRC}package/${entry}.ts`, 'utf8'))?.[0] ?? '');
}

function namesIn(file: string): PublicName[] {
  const text = readFileSync(SRC + file, 'utf8');
  return parseSync(file, text).program.body.flatMap((statement): PublicName[] => {
    if (statement.type !== 'ExportNamedDeclaration') return [];
    const { source, declaration, specifiers, start } = statement;
    if (declaration) return declared(text, declaration, start);
    if (!source) return [];
    const from = namesIn(posix.join(posix.dirname(file), source.value));
    return specifiers.map(({ exported, local }) => {
      const [name, own] = [exported, local].map((node) => ('name' in node ? node.name : node.value));
      const found = from.find((one) => one.name === own);
      if (!found) throw new Error(`${file}: ${source.value} does not declare ${own}.`);
      return { ...found, name };
    });
  });
}

function declared(text: string, declaration: ESTree.Declaration, start: number): PublicName[] {
  const comment = plain(text.slice(text.lastIndexOf('/**', start), start));
  if (declaration.type === 'VariableDeclaration') {
    return declaration.declarations.map(({ id, end, init }) => ({
      ...{ name: 'name' in id ? id.name : '', isType: false, comment },
      signature: text.slice(id.start, init ? init.start : end).replace(/\s*=\s*$/, ''),
    }));
  }
  if (!('id' in declaration) || !declaration.id || !('name' in declaration.id)) return [];
  const { name } = declaration.id;
  const isFunction = declaration.type === 'FunctionDeclaration';
  const end = isFunction && declaration.body ? declaration.body.start : declaration.end;
  const isType = declaration.type.startsWith('TS');
  if (declaration.type === 'ClassDeclaration') {
    return [{ name, isType, comment, signature: classSignature(text, declaration) }];
  }
  return [
    {
      name,
      isType,
      comment,
      signature: text
        .slice(declaration.start, end)
        .trim()
        .replace(/^(async )?function /, ''),
    },
  ];
}

/** What programs may use of a class, methods up to their bodies. */
function classSignature(text: string, { start, body }: ESTree.Class): string {
  let before = body.start + 1;
  const members = body.body.map((member) => {
    const comment = /\/\*\*.*\*\//s.exec(text.slice(before, member.start))?.[0];
    before = member.end;
    if (!('accessibility' in member) || member.accessibility === 'private' || !('key' in member)) return undefined;
    // Called by the browser.
    const key = text.slice(member.key.start, member.key.end);
    if (/^(constructor|observedAttributes|\w+Callback)$/.test(key)) return undefined;
    const { value } = member;
    const end = value?.type === 'FunctionExpression' && value.body ? value.body.start : member.end;
    const signature = `${text.slice(member.start, end).trim().replace(/;$/, '')};`;
    return comment === undefined ? `  ${signature}` : `  ${comment}\n  ${signature}`;
  });
  return `${text.slice(start, body.start)}{\n${members.filter((member) => member !== undefined).join('\n')}\n}`;
}

function plain(comment: string): string {
  const lines = comment
    .trim()
    .replace(/^\/\*\*\s?/, '')
    .replace(/\s*\*\/$/, '')
    .split('\n');
  return lines
    .map((line) => line.replace(/^\s*\* ?/, ''))
    .join('\n')
    .trim();
}
