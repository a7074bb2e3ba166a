using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>An object of a scene: a model and where it stands (paper §4.1.5).</summary>
/// <remarks>
/// An object made in code has a <see cref="Model"/>. One that a scene file declares has the name of a <see cref="File"/>, and its model
/// once that file is loaded. Two objects are equal when all that a scene file says of them is equal, models included where no file is
/// named.
/// </remarks>
public record SceneObject
{
    private Model? _model;

    // Apart, since few objects of large scenes have any.
    private Options _options = Options.None;

    /// <summary>Makes an object that shows a model.</summary>
    public SceneObject(Model model) => Model = model;

    /// <summary>Makes an object that shows a fractal.</summary>
    public SceneObject(Fractal fractal)
        : this(new FractalModel(fractal))
    {
    }

    /// <summary>Makes an object that shows a mesh.</summary>
    public SceneObject(Mesh mesh)
        : this(new MeshModel(mesh))
    {
    }

    /// <summary>Makes an object that shows what a file holds, which is not loaded yet.</summary>
    /// <param name="file">As the scene names it: relative to the scene's file.</param>
    /// <param name="placement">The paper's global matrix m.</param>
    public SceneObject(string file, Transformation placement)
    {
        File = file;
        Placement = placement;
    }

    /// <summary>Mesh or fractal that the object shows; null for an object whose file is not loaded.</summary>
    public Model? Model
    {
        get => _model;
        init => _model = value;
    }

    /// <summary>The model's file as the scene names it, relative to the scene's file; null for an object made in code.</summary>
    public string? File { get; init; }

    /// <summary>The paper's global matrix m, from the model's frame to world space.</summary>
    public Transformation Placement { get; init; } = Transformation.Identity;

    /// <summary>A name to tell objects of the same file apart; null for none.</summary>
    public string? Name
    {
        get => _options.Name;
        init => _options = _options.Name == value ? _options : _options with { Name = value };
    }

    /// <summary>The object's colour; null for the default.</summary>
    public Colour? Colour
    {
        get => _options.Colour;
        init => _options = _options.Colour == value ? _options : _options with { Colour = value };
    }

    /// <summary>How the instances of a fractal differ in colour; null for not at all.</summary>
    public Gradient? Gradient
    {
        get => _options.Gradient;
        init => _options = _options.Gradient == value ? _options : _options with { Gradient = value };
    }

    /// <summary>How the object moves by itself; null for one that stands. Bodies move by forces instead, and ignore it.</summary>
    public ObjectMotion? Motion
    {
        get => _options.Motion;
        init => _options = _options.Motion == value ? _options : _options with { Motion = value };
    }

    /// <summary>Velocity of the object's surface along itself, as that of a belt; units a second, about the placed object's axes.</summary>
    /// <remarks>The object stands, or moves as <see cref="Motion"/> says, and what lies on it is carried along besides.</remarks>
    public Vector Belt
    {
        get => _options.Belt;
        init => _options = _options with { Belt = value };
    }

    /// <summary>The name for messages: the object's own, or that of its file or model.</summary>
    public string DisplayName => Name ?? File ?? Model?.Name ?? "object";

    /// <summary>
    /// Gives an object that a scene file declares what its file holds. This very object has the model then: scenes of a hundred thousand
    /// objects would take twice the memory for a while if each were copied.
    /// </summary>
    /// <param name="model">Contents of <see cref="File"/>.</param>
    /// <exception cref="InvalidOperationException">The object has a model, or names no file.</exception>
    public void AttachModel(Model model)
    {
        ArgumentNullException.ThrowIfNull(model);
        if (_model is not null || File is null)
        {
            throw new InvalidOperationException($"the object '{DisplayName}' does not wait for the model of its file");
        }

        _model = model;
    }

    /// <summary>The same object with another placement. Where it moves by itself, it does so from there.</summary>
    public SceneObject MovedTo(Transformation placement) =>
        this with { Placement = placement, Motion = Motion?.MovedBy(placement.Position - Placement.Position) };

    /// <inheritdoc/>
    public virtual bool Equals(SceneObject? other) =>
        other is not null && EqualityContract == other.EqualityContract && File == other.File
        && (File is not null || ReferenceEquals(Model, other.Model)) && Placement == other.Placement && Name == other.Name
        && Colour == other.Colour && Gradient == other.Gradient && Motion == other.Motion && Belt == other.Belt;

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(EqualityContract, File, Placement, Name, Colour, Gradient, Motion, Belt);

    private sealed record Options(string? Name, Colour? Colour, Gradient? Gradient, ObjectMotion? Motion, Vector Belt)
    {
        public static Options None { get; } = new(null, null, null, null, Vector.Zero);
    }
}
