"""The base of operators with long work: it runs beside Blender, shows progress, and Esc cancels it."""

import bpy

from .samara_library import SamaraError


class JobOperator:
    """Base class of an operator that defines three methods:

    start(context): prepares the job and returns it; the scene stays as it is. May raise a SamaraError.
    finish(context): puts what the job made into the scene, and returns what an operator returns.
    status(): one line for the time while it runs.

    A job has progress() from 0 to 1, is_done(), wait() and cancel(); is_done() and wait() raise the SamaraError that
    ended it.
    """

    WHILE_RUNNING = {"RUNNING_MODAL"}  # blocks other input; {"PASS_THROUGH"} does not
    CANCELLED = "cancelled; nothing has changed"

    job = None

    def execute(self, context):
        try:
            self.job = self.start(context)
            self.job.wait()
        except SamaraError as error:
            return self._refuse(error)
        return self.finish(context)

    def invoke(self, context, event):
        if bpy.app.background:  # which has no timers
            return self.execute(context)
        try:
            self.job = self.start(context)
        except SamaraError as error:
            return self._refuse(error)
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self._timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.cancel(context)
            self.report({"WARNING"}, self.CANCELLED)
            return {"CANCELLED"}
        if event.type != "TIMER":
            return self.WHILE_RUNNING
        context.window_manager.progress_update(100.0 * self.job.progress())
        context.workspace.status_text_set(f"{self.status()} (Esc cancels)")
        try:
            if not self.job.is_done():
                return self.WHILE_RUNNING
        except SamaraError as error:
            self.cancel(context)
            return self._refuse(error)
        self.cancel(context)
        return self.finish(context)

    def cancel(self, context):
        """Ends the job where it still runs, and removes the progress. Blender calls it too when it closes."""
        self.job.cancel()
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)

    def _refuse(self, error):
        self.report({"ERROR"}, str(error))
        return {"CANCELLED"}
