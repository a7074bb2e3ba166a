namespace FractalEngine.Parsing.Scenes;

/// <summary>Kind of declaration on a line of a scene file.</summary>
public enum SceneDeclarationKind
{
    /// <summary>How coordinates are shown: <c>handed left</c> or <c>handed right</c>.</summary>
    Handedness,

    /// <summary>Declaration of the camera: <c>c (x, y, z) (pitch, yaw, roll) fov</c>.</summary>
    Camera,

    /// <summary>Choice of the projection: <c>projection perspective</c> or <c>projection orthographic [height]</c>.</summary>
    Projection,

    /// <summary>Aspect ratio of the frame: <c>aspect width:height</c> or <c>aspect ratio</c>.</summary>
    Aspect,

    /// <summary>Near and far clip plane: <c>clip near far</c>.</summary>
    Clip,

    /// <summary>Colour of the background: <c>background (r, g, b)</c>.</summary>
    Background,

    /// <summary>Declaration of one light: <c>light kind …</c>.</summary>
    Light,

    /// <summary>Acceleration of all bodies: <c>gravity (x, y, z)</c>.</summary>
    Gravity,

    /// <summary>Declaration of the player: <c>player (x, y, z) radius height</c>.</summary>
    Player,

    /// <summary>Declaration of one object: <c>o "file" matrix …</c> or <c>p "file" matrix e …</c>.</summary>
    SceneObject,
}
