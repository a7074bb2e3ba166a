namespace FractalEngine.App.Window.Drawing;

/// <summary>How many frames a window has drawn, compared with a loop that draws 60 frames a second.</summary>
/// <param name="Drawn">Number of frames drawn.</param>
/// <param name="PresentedAgain">Number of frames presented again without drawing, below a new overlay.</param>
/// <param name="Skipped">Number of frames neither drawn nor presented, since nothing had changed.</param>
internal readonly record struct FrameCounts(long Drawn, long PresentedAgain, long Skipped);
