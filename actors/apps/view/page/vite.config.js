// Builds one page in one file: script and style are inlined, and a policy forbids running or
// fetching anything else. The program serves only this file.
import { createHash } from 'node:crypto';
import { defineConfig } from 'vite';

const hashOf = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

const policy = (script, style) =>
  [
    "default-src 'none'",
    `script-src ${hashOf(script)}`,
    `style-src ${hashOf(style)}`,
    "connect-src 'self'",
    'img-src data:',
    "base-uri 'none'",
    "form-action 'none'",
  ].join('; ');

function oneFile() {
  return {
    name: 'one-file',
    enforce: 'post',
    generateBundle(_, bundle) {
      const parts = Object.values(bundle);
      const page = parts.find((p) => p.fileName.endsWith('.html'));
      const style = parts.filter((p) => p.fileName.endsWith('.css'));
      const script = parts.filter((p) => p.type === 'chunk');
      if (!page || style.length !== 1 || script.length !== 1)
        throw new Error('expected one page, one style and one script');
      const css = String(style[0].source);
      const code = script[0].code.replaceAll('</script', '<\\/script');
      const head =
        `<meta http-equiv="Content-Security-Policy" content="${policy(code, css)}">` +
        `<style>${css}</style>`;
      page.source = String(page.source)
        .replace(/<script[^>]*src=[^>]*><\/script>\s*/, '')
        .replace(/<link[^>]*stylesheet[^>]*>\s*/, '')
        .replace('</title>', () => `</title>${head}`)
        .replace('</body>', () => `<script type="module">${code}</script></body>`);
      for (const part of [...style, ...script]) delete bundle[part.fileName];
    },
  };
}

export default defineConfig({
  base: './',
  plugins: [oneFile()],
  build: {
    target: 'es2022',
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 1 << 20,
    chunkSizeWarningLimit: 2048,
    reportCompressedSize: false,
  },
});
