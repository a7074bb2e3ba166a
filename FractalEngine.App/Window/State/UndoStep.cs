using FractalEngine.App.Cameras;
using FractalEngine.App.Window.Files;

namespace FractalEngine.App.Window.State;

/// <summary>What an undo returns to: the view, and the texts of the files.</summary>
/// <param name="Camera">The state of the flying camera.</param>
/// <param name="Edits">The files that were edited and not saved.</param>
internal sealed record UndoStep(CameraState Camera, FileEdits Edits);
