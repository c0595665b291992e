/** What the driver says about a program that it refuses. */
export function shaderError(gl: WebGLRenderingContext, program: WebGLProgram, shaders: readonly WebGLShader[]): Error {
  const logs = [...shaders.map((shader) => gl.getShaderInfoLog(shader)), gl.getProgramInfoLog(program)];
  // Some drivers end their logs with a zero.
  const said = logs.map((log) => log?.replaceAll('\0', '').trim()).filter(Boolean);
  return new Error(`A shader does not compile. ${said.join('\n')}`);
}
