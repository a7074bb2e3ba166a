namespace FractalEngine.App.Commands;

/// <summary>What can be left out without being missed, for <c>--without</c>.</summary>
internal enum Skip
{
    /// <summary>The backs of closed meshes.</summary>
    Backs,

    /// <summary>What lies beside the picture.</summary>
    Outside,

    /// <summary>What is hidden behind nearer things.</summary>
    Hidden,

    /// <summary>Faces without area.</summary>
    EmptyFaces,

    /// <summary>GL state that holds already.</summary>
    State,

    /// <summary>Uploads of what has not changed.</summary>
    Buffers,

    /// <summary>Reading and decoding a file that another object shows already.</summary>
    Sharing,

    /// <summary>Preparing what has not been in sight.</summary>
    Sight,

    /// <summary>Pictures like the one before.</summary>
    Still,
}
