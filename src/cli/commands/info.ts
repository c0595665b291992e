/** `marrow info`: what files contain, their problems, and which of them belong together. */
import { keysOf } from '../../model/clip.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import { type Character, type Document, EMPTY_DOCUMENT } from '../../model/document.ts';
import { jointDofCount } from '../../model/dofs.ts';
import type { FileContent } from '../../model/files.ts';
import { rangeOfSamples } from '../../model/samples.ts';
import { bindingCount, type Skin, vertexCount } from '../../model/skin.ts';
import { openFiles } from '../../project/open/open-files.ts';
import { refusal } from '../../project/save/conversion.ts';
import { parseArguments } from '../arguments.ts';
import type { CliCommand } from '../io.ts';
import { type LoadedFile, loadFiles } from '../load.ts';
import { printJson, report } from '../report.ts';

export const info: CliCommand = {
  name: 'info',
  usage: 'FILE… [--json]',
  summary: 'what files hold, and what is wrong with them, alone and together',
  async run(args, io) {
    const given = parseArguments(args, { json: 'flag' });
    const loaded = loadFiles(given.files, io.folder);
    const opened = openFiles(EMPTY_DOCUMENT, loaded.files, loaded.broken);
    const diagnostics = [...loaded.diagnostics, ...opened.diagnostics];
    // A folder counts by its content.
    if (loaded.all.length === 0) {
      diagnostics.push(refusal('nothing-found', 'There is no readable file here.', given.files.join(' ')));
    }
    report(diagnostics, io);
    const files = loaded.all.map(describeFile);
    if (given.flag('json')) {
      const { document } = opened;
      const unused = document.unused.map(({ file, why }) => ({ name: file.source.name, why }));
      await printJson({ files, characters: document.characters.map(describeCharacter), unused, diagnostics }, io);
    } else if (files.length > 0) await io.out(asText(files, opened.document));
    return hasErrors(diagnostics) ? 1 : 0;
  },
};

interface FileFacts {
  readonly name: string;
  readonly kind: string;
  readonly loaded: boolean;
  readonly [count: string]: unknown;
}

function describeFile({ name, kind, content }: LoadedFile): FileFacts {
  return { name, kind, loaded: content !== undefined, ...(content && counts(content)) };
}

function counts(content: FileContent): Record<string, unknown> {
  switch (content.kind) {
    case 'skel': {
      const { skeletons } = content;
      return {
        joints: sum(skeletons.map((s) => s.joints.length)),
        dofs: sum(skeletons.map(jointDofCount)),
        roots: skeletons.length,
        ...(skeletons[0]?.form && { form: skeletons[0].form }),
      };
    }
    case 'skin': {
      const { skin } = content;
      return {
        vertices: vertexCount(skin),
        triangles: skin.triangles.length / 3,
        maxAttachments: maxAttachments(skin),
        bindings: bindingCount(skin),
        texcoords: (skin.texcoords?.length ?? 0) / 2,
      };
    }
    case 'morph':
      return { positions: content.morph.positions.indices.length, normals: content.morph.normals.indices.length };
    case 'anim': {
      const { channels, range } = content.clip;
      return { channels: channels.length, keys: sum(channels.map((c) => keysOf(c).times.length)), range };
    }
    case 'rig': {
      const { skeleton, skin, morphs, animation } = content.rig;
      return { parts: [skeleton, skin, ...morphs, animation].filter((part) => part !== undefined) };
    }
    case 'bvh': {
      const { figures } = content;
      const joints = figures.flatMap(({ skeleton }) => skeleton.joints);
      // The same for all roots of a capture: a frame holds the channels of all of them.
      const samples = figures.find(({ clip }) => clip?.samples)?.clip?.samples;
      const range = samples && rangeOfSamples(samples);
      return {
        joints: joints.length,
        endSites: sum(joints.map(({ endSites = [] }) => endSites.length)),
        dofs: sum(figures.map(({ skeleton }) => jointDofCount(skeleton))),
        roots: figures.length,
        frames: samples?.frameCount ?? 0,
        ...(samples && range && { frameTime: samples.frameSeconds, duration: range[1] - range[0] }),
      };
    }
    case 'pose':
      return { poses: content.poses.length, names: content.poses.map(({ name }) => name) };
    case 'texture':
      return { mime: content.texture.mime, bytes: content.texture.bytes.length };
  }
}

function maxAttachments({ attachments }: Skin): number {
  let most = 0;
  const start = attachments?.start ?? [];
  for (let v = 0; v + 1 < start.length; v++) most = Math.max(most, start[v + 1] - start[v]);
  return most;
}

function sum(values: readonly number[]): number {
  return values.reduce((total, value) => total + value, 0);
}

function describeCharacter({ name, skeleton, skins, morphs, clips, sources }: Character) {
  return {
    name,
    joints: skeleton?.joints.length ?? 0,
    skins: skins.map((s) => s.name),
    morphs: morphs.map((m) => m.name),
    clips: clips.map((c) => c.name),
    files: sources.map((s) => s.path),
  };
}

/** `wasp.skel   skel   joints 19, dofs 57, roots 1`, then the characters and files left unused. */
function asText(files: readonly FileFacts[], { characters, unused }: Document): string {
  const width = Math.max(...files.map((f) => f.name.length));
  const lines = files.map(({ name, kind, loaded, ...rest }) => {
    const facts = Object.entries(rest).map(
      ([key, value]) => `${key} ${Array.isArray(value) ? value.join(' ') : value}`,
    );
    const text = loaded ? facts.join(', ') : 'not loaded';
    return `${name.padEnd(width)}  ${kind.padEnd(7)}  ${text}`;
  });
  for (const { name, sources } of characters) {
    lines.push(`character ${name}: ${sources.map((source) => source.path).join(', ')}`);
  }
  for (const { file, why } of unused) lines.push(`unused ${file.source.name}: ${why}`);
  return `${lines.join('\n')}\n`;
}
