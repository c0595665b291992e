/**
 * Files that are not what their name says, and kinds that are not read: what each is called, and how to get from it to
 * a file that is read. One table, for the readers of all kinds, told by the first bytes, and for files of other
 * extensions, which have no reader.
 */
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { besideOf, FORMAT_KINDS, type FormatKind, READABLE_EXTENSIONS } from './kinds.ts';

/** Bytes at the start of a file that tell what it is. */
export const HEAD_BYTES = 1024;
/** ␀ */
const CONTROL_PICTURES = 0x2400;

/** The kinds that readers are for: zips are read as the files in them. */
export type ContentKind = FormatKind | 'zip';

interface Foreign {
  /** With its article. */
  readonly name: string;
  /** How it becomes something that is read; a sentence. */
  readonly now: string;
  /** Without dots, in lower case: files of these kinds have no reader. */
  readonly extensions?: readonly string[];
  /**
   * Pattern of its first bytes, a character for each; control characters but tabs and line ends as their pictures, such
   * as ␀.
   */
  readonly start?: RegExp;
  /** Kinds that may start like this. */
  readonly of?: readonly ContentKind[];
}

/** Numbers of other programs. */
const DUMPS: readonly ContentKind[] = ['dump', 'table'];
/** The words of these tell which of them a file is: all of them are looked at (`formats/diagnose/kinds.ts`). */
const TEXTS: readonly ContentKind[] = ['skel', 'axskel', 'skin', 'morph', 'anim', 'rig', 'bvh', 'pose'];

const OPEN_AGAIN = 'and open it again';
const UNPACK = `Unpack it ${OPEN_AGAIN}.`;
const BY_BLENDER = `Import it into Blender, export it as glTF (.glb) ${OPEN_AGAIN}.`;
const BY_MAYA = 'In Maya, export the character as FBX and open that.';
const TO_PNG = 'Save it as PNG and open that.';

/** Files that aren't read at all come first: some of it looks like text, or like XML. */
const FOREIGN: readonly Foreign[] = [
  {
    name: 'a Git LFS pointer',
    now: 'Run "git lfs pull" in its repository, or download the file itself from there.',
    start: /^version https:\/\/(git-lfs\.github\.com|hawser\.github\.com)\//,
  },
  {
    name: 'a web page',
    now: 'Download the file itself, with "Raw" or "Download" on that page.',
    extensions: ['html', 'htm'],
    start: /^\s*(<\?xml[^>]*>\s*)?(<!--.*?-->\s*)?<(!doctype\s+html|html|head|body|script|meta)\b/is,
  },
  {
    name: 'the error page of a web server',
    now: 'Download it again.',
    start: /^(404: Not Found|\s*\{\s*"message":\s*"Not Found"|\s*(<\?xml[^>]*>\s*)?<Error>)/i,
  },
  {
    name: 'a Unity file in YAML',
    now: 'In Unity, export it with the FBX Exporter and open the .fbx.',
    extensions: ['prefab', 'unity', 'unitypackage', 'asset'],
    start: /^%YAML.*?tag:unity3d\.com/s,
  },
  {
    name: 'a YAML file',
    now: 'Export a file of that type from the program that made it.',
    extensions: ['yaml', 'yml'],
    start: /^(#[^\n\r]*[\n\r]+)*(%YAML|---[\s!])/,
    // Headings begin with dashes.
    of: DUMPS,
  },
  { name: 'a Maya animation', now: BY_MAYA, start: /^animVersion\b/ },
  { name: 'a Maya scene', now: BY_MAYA, extensions: ['ma', 'mb'], start: /^(\/\/Maya ASCII|FOR[48].{4,12}MAYA)/s },
  {
    name: 'a Blender scene',
    now: 'In Blender, export it as glTF (.glb) and open that.',
    extensions: ['blend'],
    start: /^BLENDER([-_][vV]|\d\d-)/,
  },
  {
    name: 'a 3ds Max scene',
    now: 'In 3ds Max, export the character as FBX and open that.',
    extensions: ['max', 'bip'],
  },
  {
    name: 'a Cinema 4D scene',
    now: 'In Cinema 4D, export the character as FBX and open that.',
    extensions: ['c4d'],
  },
  { name: 'a USD file', now: BY_BLENDER, extensions: ['usd', 'usda', 'usdc', 'usdz'], start: /^(#usda|PXR-USDC)/ },
  {
    name: 'a COLLADA file',
    now: BY_BLENDER,
    extensions: ['dae'],
    start: /^\s*(<\?xml[^>]*>\s*)?(<!--.*?-->\s*)?<COLLADA\b/s,
  },
  { name: 'an Alembic file', now: BY_BLENDER, extensions: ['abc'], start: /^Ogawa/ },
  {
    name: 'an Acclaim skeleton',
    now: renamed('asf'),
    start: /^\s*(#[^\n\r]*[\n\r]\s*)*:version\b/i,
    of: ['asf'],
  },
  {
    name: 'Acclaim motion',
    now: renamed('amc'),
    of: ['amc'],
    start: /^(\s*#!OML|\s*(#[^\n\r]*[\n\r]\s*)*:fully-specified\b)/i,
  },
  {
    name: 'a C3D file',
    now: renamed('c3d'),
    start: /^[␁-␈]P.{6}/s,
    of: ['c3d'],
  },
  {
    name: 'an OpenSim file',
    now: 'Fit a skeleton to it in motion capture software, export it as .bvh and open that.',
    extensions: ['mot', 'sto', 'osim'],
  },
  {
    name: 'MikuMikuDance motion',
    now: 'Import it into Blender with MMD Tools, export it as glTF (.glb) and open that.',
    extensions: ['vmd', 'pmx', 'pmd', 'vpd'],
    start: /^(Vocaloid (Motion|Pose) Data|PMX ␀␀|Pmd␀␀)/,
  },
  {
    name: 'a Valve Source engine file',
    now: 'Import it into Blender with Source Tools, export it as glTF (.glb) and open that.',
    extensions: ['smd', 'dmx', 'vta'],
    start: /^(\/\/[^\n\r]*[\n\r]+)*version 1\s+nodes\b/,
  },
  { name: 'an array of numpy', now: renamed('npy'), start: /^\x93NUMPY/, of: ['numpy'] },
  {
    name: 'a file of numeric arrays',
    now: 'Save it as .npz from the program that made it, or with a script (numpy.savez), and open that.',
    extensions: ['pkl', 'pickle', 'pt', 'h5', 'hdf5', 'mat'],
    start: /^(\x80[␂-␅].|\x89HDF|MATLAB 5\.0)/s,
  },
  {
    name: 'a mesh without a skeleton',
    now: BY_BLENDER,
    extensions: ['stl', '3ds', 'lwo', 'off'],
  },
  {
    name: 'a file from another 3D program',
    now: BY_BLENDER,
    extensions: ['x', 'x3d', 'wrl', 'md2', 'md3', 'md5mesh', 'md5anim', 'ms3d', 'b3d', 'htr', 'trb', 'xbf', 'uasset'],
    start: /^(xof \d|MD5Version|IDP[23]|MS3D0)/,
  },
  { name: 'a file compressed with gzip', now: UNPACK, extensions: ['gz', 'tgz'], start: /^␟\x8b/ },
  { name: 'a file compressed with bzip2', now: UNPACK, extensions: ['bz2'], start: /^BZh[1-9]1AY/ },
  { name: 'a file compressed with xz', now: UNPACK, extensions: ['xz'], start: /^\xfd7zXZ␀/ },
  { name: 'a file compressed with Zstandard', now: UNPACK, extensions: ['zst'], start: /^\x28\xb5\x2f\xfd/ },
  { name: 'a file compressed with LZ4', now: UNPACK, extensions: ['lz4'], start: /^␄\x22\x4d␘/ },
  { name: 'a file compressed with compress', now: UNPACK, extensions: ['z'], start: /^␟\x9d/ },
  { name: 'a 7z archive', now: UNPACK, extensions: ['7z'], start: /^7z\xbc\xaf\x27␜/ },
  { name: 'a RAR archive', now: UNPACK, extensions: ['rar'], start: /^Rar!␚/ },
  { name: 'a tar archive', now: UNPACK, extensions: ['tar'], start: /^.{257}ustar/s },
  { name: 'a zip archive', now: renamed('zip'), start: /^PK(␃␄|␅␆|␇␈)/, of: ['zip', 'numpy'] },
  { name: 'a PDF document', now: 'Open the file it describes.', extensions: ['pdf'], start: /^%PDF-/ },
  {
    name: 'a video',
    now: 'Marrow needs joints and their motion: make a .bvh or .fbx from it with motion capture software.',
    extensions: ['mp4', 'mov', 'avi', 'mkv', 'webm', 'm4v'],
    start: /^(.{4}ftyp|RIFF.{4}AVI |␚E\xdf\xa3)/s,
  },
  {
    name: 'sound',
    now: 'Open a take instead.',
    extensions: ['wav', 'mp3', 'ogg'],
    start: /^(RIFF.{4}WAVE|OggS␀|ID3[␂-␄])/s,
  },
  {
    name: 'another type of image',
    now: TO_PNG,
    extensions: ['tif', 'tiff', 'tga', 'dds', 'exr', 'hdr', 'psd', 'ktx', 'ktx2', 'gif'],
    start: /^(II\*␀|MM␀\*|8BPS␀|DDS \||v\/1␁|#\?RADIANCE|\xabKTX)/,
  },
  // Kinds that are read, under the name of another one.
  { name: 'a binary glTF', now: renamed('glb'), start: /^glTF[␁␂]␀␀␀/, of: ['gltf'] },
  { name: 'an FBX file', now: renamed('fbx'), start: /^(Kaydara FBX Binary|\s*;\s*FBX\s)/, of: ['fbx'] },
  {
    name: 'an image',
    now: 'Give it the extension of its type, such as .png, and open it again.',
    start: /^(\x89PNG|\xff\xd8\xff|GIF8[79]a|RIFF.{4}WEBP|BM.{4}␀␀␀␀)/s,
    of: ['texture'],
  },
  { name: 'motion capture (BVH)', now: renamed('bvh'), start: /^\s*hierarchy\s+root\b/i, of: TEXTS },
  {
    name: 'an animation (.anim)',
    now: renamed('anim'),
    start: /^\s*animation\s*\{\s*(range|numchannels|channel)\b/i,
    of: TEXTS,
  },
  {
    name: 'a skeleton (.skel)',
    now: renamed('skel'),
    start: /^\s*balljoint\s+\S+\s*\{\s*(offset|boxmin|boxmax|pose|rot[xyz]limit|balljoint)\b/i,
    of: TEXTS,
  },
  { name: 'a skin (.skin)', now: renamed('skin'), start: /^\s*positions\s+\d+\s*\{/i, of: [...TEXTS, ...DUMPS] },
  {
    name: 'text in UTF-16',
    now: `Save it as UTF-8 ${OPEN_AGAIN}.`,
    start: /^(\xff\xfe|\xfe\xff|([\t\n\r -~]␀){4}|(␀[\t\n\r -~]){4})/,
    of: DUMPS,
  },
  {
    name: 'a JSON file',
    now: 'Export a file of that type from the program that made it.',
    start: /^\s*[[{]\s*"/,
    of: ['gltf', ...DUMPS, ...FORMAT_KINDS.filter(besideOf)],
  },
  {
    name: 'an XML file',
    now: BY_BLENDER,
    extensions: ['xml'],
    start: /^\s*<\?xml\b/i,
    of: DUMPS,
  },
  {
    name: 'binary data',
    now: 'Export it as text, or give it the extension of its type.',
    // A name in a text may have some.
    start: /^(?:[^␀-␟]*[␀-␟]){12}/,
    of: ['gltf', 'fbx', 'texture', 'c3d', ...DUMPS],
  },
];

function renamed(extension: string): string {
  return `Change its extension to .${extension} ${OPEN_AGAIN}.`;
}

/**
 * The error about a file that starts like one of another kind; undefined if it may be what its name says.
 *
 * @param head its first `HEAD_BYTES` bytes, or all of a shorter file; more is ignored
 */
export function otherContent(fileName: string, kind: ContentKind, head: Uint8Array): Diagnostic | undefined {
  // Text readers say what they expected first.
  if (
    head.length === 0 &&
    (kind === 'zip' || kind === 'gltf' || kind === 'fbx' || kind === 'numpy' || kind === 'c3d')
  ) {
    return withoutPlace('error', 'file-empty', 'The file is empty: copy or export it again.', fileName);
  }
  const from = head[0] === 0xef && head[1] === 0xbb && head[2] === 0xbf ? 3 : 0;
  // Added up: a list of them, joined, took more than twice as long, for each file that is opened.
  let start = '';
  for (const byte of head.subarray(from, HEAD_BYTES)) start += characterOf(byte);
  // The first entry decides, since XML is what web pages are, too.
  const found = FOREIGN.find((foreign) => foreign.start?.test(start));
  if (!found || found.of?.some((own) => own === kind)) return undefined;
  const message = `This looks like ${found.name}, not a .${extensionOf(fileName)} file. ${found.now}`;
  return withoutPlace('error', 'other-kind', message, fileName);
}

/** As the patterns of the table have it. */
function characterOf(byte: number): string {
  const isControl = byte < 32 && byte !== 9 && byte !== 10 && byte !== 13;
  return String.fromCharCode(isControl ? CONTROL_PICTURES + byte : byte);
}

/** The message about a file that has no reader. */
export function unreadMessage(fileName: string): string {
  const extension = extensionOf(fileName);
  const found = FOREIGN.find(({ extensions }) => extensions?.includes(extension));
  if (found) return `Marrow does not read .${extension}: this is ${found.name}. ${found.now}`;
  return `Marrow does not read this type of file; it reads ${readableList()}.`;
}

/** `.skel .skin …`, zips included. */
export function readableList(): string {
  return [...READABLE_EXTENSIONS, 'zip'].map((extension) => `.${extension}`).join(' ');
}

/** Without the dot, in lower case; of a name without one the name. */
function extensionOf(fileName: string): string {
  return fileName.slice(fileName.lastIndexOf('.') + 1).toLowerCase();
}
