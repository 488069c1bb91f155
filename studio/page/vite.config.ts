import {defineConfig} from 'vite';

// Two scripts and one style: they are put into the program (../build_page.cmake), and no request leaves the machine. The
// second script is the editor of texts, which is loaded when a text is opened.
const ofEditor = /node_modules\/(@codemirror|@lezer|@marijn|codemirror|style-mod|w3c-keyname|crelt)\/|CodeEditor/;
export default defineConfig({
  esbuild: {jsx: 'automatic', legalComments: 'none'},
  build: {
    target: 'es2022',
    assetsInlineLimit: 0,
    cssCodeSplit: false,
    modulePreload: {polyfill: false},
    chunkSizeWarningLimit: 1200,
    rollupOptions: {
      output: {
        entryFileNames: 'studio.js',
        assetFileNames: 'studio[extname]',
        manualChunks: (id) => (ofEditor.test(id) ? 'editor' : 'studio'),
        chunkFileNames: '[name].js',
      },
    },
  },
});
