namespace FractalEngine.Core.Scenes.Cameras;

/// <summary>
/// How the coordinates of a scene are shown. It changes the image, and files in formats that are right-handed; coordinates, queries and
/// physics stay as they are.
/// </summary>
public enum Handedness
{
    /// <summary>With x to the right and y up, z points forwards, away from the viewer, as in the paper.</summary>
    Left,

    /// <summary>With x to the right and y up, z points backwards, towards the viewer, as in OBJ files and most tools.</summary>
    Right,
}
