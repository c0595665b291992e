/**
 * three.js without unused features: headsets, environment maps, and in its shaders the lights, maps and materials that
 * no object has. Bundlers can't detect this, since the renderer looks them up by name at run time. Saves a seventh of
 * three.js, gzipped.
 *
 * Removed features fail when used: modules throw, shaders don't compile (`#error`). To use one, remove it from its
 * list.
 */
import type { Plugin } from 'vite';

const SOURCE = '/node_modules/three/src/';
const SHADERS = `${SOURCE}renderers/shaders/`;
const leftOut = (what: string) => `${what} is left out of the build: see vite.three.ts`;

/** Features of materials that no object has. */
const SHADER_FILES = [
  'ShaderChunk/lights_phong_pars_fragment',
  'ShaderChunk/lights_toon_pars_fragment',
  'ShaderLib/background',
  'ShaderLib/backgroundCube',
  'ShaderLib/cube',
  'ShaderLib/equirect',
  'ShaderLib/linedashed',
  'ShaderLib/meshlambert',
  'ShaderLib/meshmatcap',
  'ShaderLib/meshphong',
  'ShaderLib/meshtoon',
  'ShaderLib/sprite',
  'ShaderLib/vsm',
];

/** Macros that three.js defines for features that no object has, or counts that are 0. */
const MACROS = [
  'NUM_CLIPPING_PLANES',
  'NUM_LIGHT_PROBE_GRIDS',
  'NUM_POINT_LIGHTS',
  'NUM_POINT_LIGHT_SHADOWS',
  'NUM_RECT_AREA_LIGHTS',
  'NUM_SPOT_LIGHTS',
  'NUM_SPOT_LIGHT_COORDS',
  'NUM_SPOT_LIGHT_MAPS',
  'NUM_SPOT_LIGHT_SHADOWS',
  'NUM_SUN_LIGHTS',
  'NUM_SUN_LIGHT_SHADOWS',
  'USE_ALPHAHASH',
  'USE_ANISOTROPY',
  'USE_AOMAP',
  'USE_BATCHING',
  'USE_BUMPMAP',
  'USE_CLEARCOAT',
  'USE_CLEARCOATMAP',
  'USE_CLEARCOAT_NORMALMAP',
  'USE_CLEARCOAT_ROUGHNESSMAP',
  'USE_DIFFUSE_ROUGHNESS',
  'USE_DISPERSION',
  'USE_DISPLACEMENTMAP',
  'USE_ENVMAP',
  'USE_FOG',
  'USE_IRIDESCENCE',
  'USE_LIGHTMAP',
  'USE_LOGARITHMIC_DEPTH_BUFFER',
  'USE_NORMALMAP',
  'USE_NORMALMAP_OBJECTSPACE',
  'USE_NORMALMAP_TANGENTSPACE',
  'USE_RETROREFLECTION',
  'USE_SHEEN',
  'USE_TRANSMISSION',
];

/** Modules, as paths in three.js's `src/`, and their replacements. */
const MODULES: Readonly<Record<string, string>> = {
  'extras/PMREMGenerator.js': thrower('PMREMGenerator'),
  'renderers/WebGLCubeRenderTarget.js': thrower('WebGLCubeRenderTarget'),
  'renderers/webgl/WebGLOutput.js': thrower('WebGLOutput'),
  // The renderer creates one of each and calls it every frame.
  'renderers/webgl/WebGLUniformsGroups.js': `
    const fail = () => { throw new Error(${JSON.stringify(leftOut('WebGLUniformsGroups'))}); };
    export const WebGLUniformsGroups = function () { return { bind: fail, update: fail, dispose() {} }; };`,
  'renderers/webxr/WebXRManager.js': `
    import { EventDispatcher } from '../../core/EventDispatcher.js';
    export class WebXRManager extends EventDispatcher {
      isPresenting = false;
      get enabled() { return false; }
      set enabled(on) { if (on) throw new Error(${JSON.stringify(leftOut('WebXRManager'))}); }
      getEnvironmentBlendMode() {}
      setAnimationLoop() {}
      dispose() {}
    }`,
};

function thrower(name: string): string {
  return `export class ${name} { constructor() { throw new Error(${JSON.stringify(leftOut(name))}); } }`;
}

/** Bundles three.js from its sources, without the above. */
export function leanThree(): Plugin {
  const unseen = new Set([...SHADER_FILES, ...MACROS, ...Object.keys(MODULES)]);
  return {
    name: 'lean-three',
    apply: 'build',
    enforce: 'pre',
    config: () => ({ resolve: { alias: [{ find: /^three$/, replacement: 'three/src/Three.js' }] } }),
    load(id) {
      const path = id.split(SOURCE)[1] ?? '';
      if (Object.hasOwn(MODULES, path)) {
        unseen.delete(path);
        return MODULES[path];
      }
      const shader = id.split(SHADERS)[1]?.replace('.glsl.js', '') ?? '';
      if (!SHADER_FILES.includes(shader)) return;
      unseen.delete(shader);
      const error = JSON.stringify(`#error ${leftOut(shader)}`);
      return `export default ${error}; export const vertex = ${error}, fragment = ${error};`;
    },
    transform(code, id) {
      if (!id.includes(SHADERS)) return;
      const short = code.replace(/\/\* glsl \*\/`([^`]*)`/g, (_, glsl: string) => `\`${leaner(glsl, unseen)}\``);
      return { code: short, map: null };
    },
    buildEnd(error) {
      // A later three.js may have renamed it, which would silently bring it back.
      if (!error && unseen.size > 0) this.error(`vite.three.ts: three.js has no ${[...unseen].join(', ')} any more`);
    },
  };
}

/**
 * GLSL without comments and indentation, and without code compiled only if one of the macros is defined or above 0.
 *
 * @param unseen macros found are removed from it
 */
export function leaner(glsl: string, unseen = new Set<string>()): string {
  const kept: string[] = [];
  /** Nesting depth within removed code; 0: code is kept. */
  let skipped = 0;
  for (const line of glsl.replace(/\/\*[\s\S]*?\*\//g, '').split('\n')) {
    const text = line.replace(/\/\/.*/, '').trim();
    if (!text) continue;
    if (skipped > 0) {
      if (/^#\s*if/.test(text)) skipped++;
      else if (/^#\s*endif/.test(text) || (skipped === 1 && /^#\s*el/.test(text))) skipped--;
      if (skipped > 0) continue;
    }
    kept.push(text);
    const macro = neededMacro(text);
    if (!macro) continue;
    unseen.delete(macro);
    // In lower case, since three.js replaces names such as NUM_SPOT_LIGHTS by numbers.
    kept.push(`#error ${leftOut(macro.toLowerCase())}`);
    skipped = 1;
  }
  return kept.join('\n');
}

/** The macro that is required for the code after a condition to be compiled. */
function neededMacro(line: string): string | undefined {
  if (!/^#\s*(if|ifdef|elif)\b/.test(line) || /\|\||[!=<]/.test(line)) return undefined;
  return MACROS.find((macro) => new RegExp(`\\b${macro}\\b`).test(line));
}
