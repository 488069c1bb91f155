import {createRoot} from 'react-dom/client';
import '@xyflow/react/dist/base.css';
import 'uplot/dist/uPlot.min.css';
import './studio.css';
import {App} from './App';

createRoot(document.getElementById('studio')!).render(<App />);
