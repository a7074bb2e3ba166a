namespace FractalEngine.Parsing.Sdo;

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

    /// <summary>Light and background from all around: <c>sky (zenith) (horizon) [ground]</c> or <c>sky "file" …</c>.</summary>
    Sky,

    /// <summary>Place of the reflection probe: <c>probe (x, y, z)</c>.</summary>
    Probe,

    /// <summary>Factor of all light: <c>exposure factor</c>.</summary>
    Exposure,

    /// <summary>Curve from light to the screen: <c>tone none</c> or <c>tone filmic</c>.</summary>
    Tone,

    /// <summary>Haze before distant surfaces: <c>fog density [colour] [scatter share] [forward cosine]</c>.</summary>
    Fog,

    /// <summary>Declaration of one light: <c>light kind …</c> or <c>sun …</c>.</summary>
    Light,

    /// <summary>Acceleration of all bodies: <c>gravity (x, y, z)</c>.</summary>
    Gravity,

    /// <summary>Declaration of the player: <c>player (x, y, z) radius height</c>.</summary>
    Player,

    /// <summary>Duration of the film: <c>film seconds</c>.</summary>
    Film,

    /// <summary>One key of the film: <c>at seconds c …</c> or <c>at seconds name = value …</c>.</summary>
    FilmKey,

    /// <summary>Declaration of one object: <c>o "file" matrix …</c> or <c>p "file" matrix e …</c>.</summary>
    SceneObject,
}
