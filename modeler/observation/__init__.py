"""Logs to y = W beta: reading, filtering, decimation, stacking."""

from modeler.observation.excitation import Excitation as Excitation
from modeler.observation.excitation import excitation as excitation
from modeler.observation.log import Log as Log
from modeler.observation.motion import Segment as Segment
from modeler.observation.observation import Observation as Observation
from modeler.observation.observation import observe as observe
from modeler.observation.processing import Processing as Processing
from modeler.observation.processing import processing_from_json as processing_from_json
from modeler.observation.read import read_log as read_log
from modeler.observation.report import DataReport as DataReport
from modeler.observation.report import JointReport as JointReport
from modeler.observation.report import LogReport as LogReport
