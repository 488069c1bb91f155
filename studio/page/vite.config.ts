import {defineConfig} from 'vite';

// One script, one style: they are put into the program (../build_page.cmake), and no request leaves the machine.
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
        manualChunks: () => 'studio',
        chunkFileNames: 'studio.js',
      },
    },
  },
});
