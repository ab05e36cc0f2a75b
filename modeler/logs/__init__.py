"""Logs as people have them: many formats, any names and units, as named columns in ours."""

from modeler.logs.log_table import LogTable as LogTable
from modeler.logs.mapping import LogMap as LogMap
from modeler.logs.mapping import map_from_table as map_from_table
from modeler.logs.mapping import map_from_words as map_from_words
