namespace FractalEngine.Parsing.Scenes;

/// <summary>What a line of a scene file declares.</summary>
public enum SceneDeclarationKind
{
    /// <summary><c>c (x, y, z) (pitch, yaw, roll) fov</c></summary>
    Camera,

    /// <summary><c>projection perspective</c> or <c>projection orthographic [height]</c></summary>
    Projection,

    /// <summary><c>aspect width:height</c> or <c>aspect ratio</c></summary>
    Aspect,

    /// <summary><c>clip near far</c></summary>
    Clip,

    /// <summary><c>background (r, g, b)</c></summary>
    Background,

    /// <summary><c>light kind …</c></summary>
    Light,

    /// <summary><c>gravity (x, y, z)</c></summary>
    Gravity,

    /// <summary><c>player (x, y, z) radius height</c></summary>
    Player,

    /// <summary><c>o "file" matrix …</c> or <c>p "file" matrix e …</c></summary>
    SceneObject,
}
