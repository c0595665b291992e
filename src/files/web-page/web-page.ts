/**
 * A page that shows characters without a network, opened from disk: `<marrow-viewer>`, and their files. It is plain
 * HTML, with all of the following in the order of the file:
 *
 *     a policy                    only the scripts and the style of this page, by their hashes; nothing from anywhere
 *     <marrow-viewer …>           how it is shown
 *     <pre data-file="NAME">      a file, as text
 *     <pre data-packed="NAME">    a file, deflated, in the signs of `formats/base91.ts`: where that is smaller, or bytes
 *     <pre data-shown>            what no file says, as JSON: `shown-characters.ts`
 *     <pre data-viewer>           the element's script, packed as well
 *     <script>                    unpacks and runs that
 *
 * Nothing in a file can be markup: `&` and `<` are written as references, and no other sign begins any in a `<pre>`.
 */
import { retargetBaked } from '../../edit/commands/retarget.ts';
import { withPlainTakes } from '../../edit/limbs/plain-takes.ts';
import { provideRetargeting } from '../../evaluate/retarget/driving.ts';
import type { Character } from '../../model/document.ts';
import { VERSION } from '../../model/version.ts';
import { ownFiles, ownFolders } from '../save/own-files.ts';
import { packedText } from './packed.ts';
import { shownOf } from './shown-characters.ts';

/** Contents of a page. */
export interface WebPage {
  readonly characters: readonly Character[];
  readonly theme: 'light' | 'dark';
  /** Of the element, besides `background`; an empty text for those without a value. */
  readonly attributes: Readonly<Record<string, string>>;
}

/** The scripts and the style of every page, by `plugins/web-page.ts`. */
export interface PageScripts {
  /** Packed. */
  readonly viewer: string;
  readonly loader: string;
  readonly style: string;
  readonly policy: string;
}

/**
 * The page, in pieces: together they may be longer than one text can be.
 * @throws Error, in a sentence, if a character can't be written
 */
export function webPage({ characters, theme, attributes }: WebPage, scripts: PageScripts): readonly string[] {
  const written = characters.map(asFilesHold);
  const folders = ownFolders(written);
  const title = escaped(written.map(({ name }) => name).join(', ') || 'Marrow');
  const said = Object.entries<string>({ ...attributes, background: theme })
    .map(([name, value]) => (value === '' ? ` ${name}` : ` ${name}="${escaped(value)}"`))
    .join('');
  const files = written.flatMap((character, i) =>
    ownFiles(character, 'plain').map(({ name, content }) => filePart(`${folders[i]}/${name}`, content)),
  );
  const shown = JSON.stringify(written.map((character, i) => shownOf(character, folders[i])));
  return [
    `<!doctype html>
<!--
  Characters to look at, made by Marrow ${VERSION}. Open this file in a browser: it needs no network and loads nothing.
  Below are the element that shows them, whose attributes may be changed; their files; and the viewer's script.
-->
<html lang="en" data-theme="${theme}">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${scripts.policy}">
<meta name="viewport" content="width=device-width">
<meta name="generator" content="Marrow ${VERSION}">
<title>${title}</title>
<style>${scripts.style}</style>
</head>
<body>
<marrow-viewer${said}></marrow-viewer>
<noscript>It takes scripts to show the characters of this page.</noscript>
`,
    ...files,
    `<pre hidden data-shown>\n${escaped(shown)}</pre>\n<pre hidden data-viewer>\n`,
    scripts.viewer,
    `</pre>\n<script type="module">${scripts.loader}</script>\n</body>\n</html>\n`,
  ];
}

/** With what plain files can't say: a retargeted take becomes its own, layers, goals and attachments part of theirs. */
function asFilesHold(character: Character): Character {
  provideRetargeting();
  return withPlainTakes(character.driver ? retargetBaked(character) : character);
}

/** Characters of a text that is left as it is, to be read by people. */
const READABLE = 8_000;

function filePart(name: string, content: string | Uint8Array<ArrayBuffer>): string {
  const isText = typeof content === 'string' && isKept(content);
  const plain = isText && `<pre hidden data-file="${escaped(name)}">\n${escaped(content)}</pre>\n`;
  if (plain && content.length <= READABLE) return plain;
  const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
  const packed = `<pre hidden data-packed="${escaped(name)}">\n${packedText(bytes)}</pre>\n`;
  return plain && plain.length <= packed.length ? plain : packed;
}

/** Whether HTML hands a text on as it is: not if it has other line ends, NUL, or halves of signs. */
function isKept(text: string): boolean {
  return !/[\0\r\p{Surrogate}]/u.test(text);
}

const REFERENCES: Readonly<Record<string, string>> = { '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' };

function escaped(text: string): string {
  return text.replace(/[&<>"]/g, (sign) => REFERENCES[sign]);
}
