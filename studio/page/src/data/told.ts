// Decides how a view is read that the server tells as what differs from the one before (studio/told_views.h). What is the
// same stays the very object, so that nothing of it is drawn again. Plain functions.

import {immutableJSONPatch, type JSONPatchDocument} from 'immutable-json-patch';
import type {View} from '../types';

type Lines = Omit<View, 'text'> & {lines: string[]};

/// A view as it is told, with the name that the server knows it by.
export interface Told {
  id: string;
  view: Lines;
}

export type ToldReply = Told | {id: string; of: string; patch: JSONPatchDocument};

/// `had`: the view whose name was sent along.
export function toldOf(had: Told | null, reply: ToldReply): Told {
  if ('view' in reply) return reply;
  if (reply.of !== had?.id) throw new Error('the studio told a difference from a view that this page does not have: reload the page');
  return {id: reply.id, view: immutableJSONPatch(had.view, reply.patch) as Lines};
}

export function viewOf({view: {lines, ...rest}}: Told): View {
  return {...rest, text: lines.join('\n')};
}
