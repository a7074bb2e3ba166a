using System.Collections.Immutable;
using System.Linq.Expressions;
using System.Reflection;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests;

/// <summary>Tests that public members refuse null, and arrays that were never made, by the name of the parameter.</summary>
public sealed class NullArgumentTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();
    private readonly NullabilityInfoContext _nullability = new();

    // They stand for names of files, so that a member comes to the argument after the name.
    private string _ending = ".obj";

    public void Dispose() => _folder.Dispose();

    // Types of inner layers, whose callers have checked before: a null ends in a NullReferenceException there.
    private static readonly string[] Unchecked =
    [
        "AnimationOutput", "AtomicFile", "BodyCsvWriter", "BodyDescription", "CameraFraming",
        "CameraNavigation", "CameraZoom", "DeepZoomRayCaster", "DistinctInstances", "EditedFile",
        "EditedFileWriter", "ExactFractalCollider", "FileEdits", "FlyingCamera", "FractalAddress", "FractalBounds",
        "FractalComments", "FractalGenerator", "FractalNumber", "FractalPartList", "FractalSteps", "FractalWriter",
        "FrameRenderer", "HierarchyCollider", "ImageHeader", "LoadedScene", "LodHierarchy", "Matting", "MtlParser",
        "NewFractalFile", "NewSceneFile", "NormalGenerator", "ObjMeshWriter", "ObjSceneWriter", "PhysicsWorld", "PlacedModel",
        "PointsParser", "QueryStatistics", "RaysParser", "SceneDraft", "SceneEditor", "SceneFileMerge", "SceneFraming",
        "SceneMaterials", "SceneMerge", "SceneParser", "SceneWorld", "SceneWriter", "SimpleCollider",
        "UnshadedSurface", "UserInterface", "View", "VisibleSet",
    ];

    [Fact]
    public void PublicMembers_WithoutAnArgument_SaySo()
    {
        var results = Members().SelectMany(Test).ToArray();
        var faulty = results.Where(result => result.Outcome == nameof(NullReferenceException)).ToLookup(result => result.Type);
        Assert.Empty(faulty.Where(type => !Unchecked.Contains(type.Key)).SelectMany(type => type.Select(result => result.What)));
        // The list has no type that checks by now.
        Assert.All(Unchecked, type => Assert.True(faulty.Contains(type), $"{type} checks its arguments by now"));
        Seeded.AssertMost(results.Count(result => result.Outcome != "unmade"), results.Length, minShare: 0.8);
    }

    [Fact]
    public void EntryPoints_WithoutAnArgument_NameIt()
    {
        var names = new (string Type, string Member)[]
        {
            ("FractalFile", "Write(fractal)"), ("FractalFile", "Write(path)"), ("FractalFile", "Read(path)"), ("MeshFile", "Write(mesh)"),
            ("MeshFile", "Write(path)"), ("MeshFile", "Read(path)"), ("SceneFile", "Write(scene)"), ("SceneFile", "Write(path)"),
            ("SceneFile", "Read(path)"), ("PhysicsWorld", "Add(description)"), ("Mesh", ".ctor(positions)"),
            ("Mesh", ".ctor(vertexIndices)"), ("Mesh", "WithNormals(normals)"), ("Mesh", "WithColours(colours)"),
            ("Mesh", "WithTextureCoordinates(coordinates)"), ("Repetition", ".ctor(round)"),
            ("TransformationSet", ".ctor(transformations)"),
            ("LoadedScene", "Of(scene)"), ("SceneCollider", ".ctor(scene)"), ("SceneRayCaster", ".ctor(scene)"),
            ("FractalGenerator", "Expand(fractal)"), ("FractalGenerator", "Flatten(fractal)"), ("BoundingBoxCollider", ".ctor(mesh)"),
        };
        var results = Members().SelectMany(Test).ToLookup(result => (result.Type, result.What.Split("::")[1]), result => result.Outcome);
        Assert.All(names, name => Assert.Equal((name, "refused"), (name, Assert.Single(results[name].Distinct()))));
    }

    private static IEnumerable<MethodBase> Members() =>
        from type in new[] { typeof(Fractal).Assembly, typeof(AssetLoader).Assembly, typeof(View).Assembly }
            .SelectMany(assembly => assembly.GetExportedTypes())
        where !type.IsSpecialName && !type.ContainsGenericParameters
            && !type.IsSubclassOf(typeof(Delegate)) && !type.IsSubclassOf(typeof(Exception))
        from member in type.GetMembers(BindingFlags.Public | BindingFlags.Instance | BindingFlags.Static | BindingFlags.DeclaredOnly)
            .OfType<MethodBase>()
        where !member.ContainsGenericParameters && !member.IsSpecialName | member.IsConstructor && !member.IsAbstract
            && !member.IsDefined(typeof(CompilerGeneratedAttribute))
            && !(member.IsConstructor && type.IsAbstract)
        select member;

    private IEnumerable<(string Type, string What, string Outcome)> Test(MethodBase member) =>
        from parameter in member.GetParameters()
        where IsRequired(parameter)
        select (member.DeclaringType!.Name, $"{member.DeclaringType.Name}::{member.Name}({parameter.Name})", TestOne(member, parameter));

    private bool IsRequired(ParameterInfo parameter) => !parameter.ParameterType.IsByRef
        && (parameter.ParameterType.IsValueType
            ? IsImmutableArray(parameter.ParameterType)
            : _nullability.Create(parameter).WriteState == NullabilityState.NotNull);

    private static bool IsImmutableArray(Type type) => type.IsGenericType && type.GetGenericTypeDefinition() == typeof(ImmutableArray<>);

    private string TestOne(MethodBase member, ParameterInfo missing)
    {
        object? target;
        object?[] arguments;
        _ending = member.DeclaringType!.Name switch
        {
            "FractalFile" => ".fdo",
            "SceneFile" => ".sdo",
            "AnimationOutput" => ".png",
            _ => ".obj",
        };
        try
        {
            target = member.IsStatic || member.IsConstructor ? null : Sample(member.DeclaringType!);
            arguments = [.. member.GetParameters().Select(parameter => parameter == missing ? null : Sample(parameter.ParameterType))];
        }
        catch (Exception exception) when (exception is NotSupportedException or TargetInvocationException)
        {
            return "unmade";
        }

        try
        {
            if (member is ConstructorInfo constructor)
            {
                constructor.Invoke(arguments);
            }
            else
            {
                member.Invoke(target, arguments);
            }

            return "accepted";
        }
        catch (TargetInvocationException exception)
        {
            return exception.InnerException is ArgumentException argument && argument.ParamName == missing.Name
                ? "refused"
                : exception.InnerException!.GetType().Name;
        }
    }

    /// <summary>Makes a value of a type: one that is known, or what its shortest constructor or factory makes.</summary>
    private object? Sample(Type type)
    {
        type = type.IsByRef ? type.GetElementType()! : type;
        return Known(type)
            ?? (IsImmutableArray(type) ? type.GetField("Empty")!.GetValue(null)
            : type.IsPointer || type.IsByRefLike ? throw new NotSupportedException(type.Name)
            : type.IsValueType ? Activator.CreateInstance(type)
            : type.IsArray ? Array.CreateInstance(type.GetElementType()!, 0)
            : type.IsSubclassOf(typeof(Delegate)) ? EmptyDelegate(type)
            : type.IsInterface && type.IsGenericType && Array.CreateInstance(type.GenericTypeArguments[0], 0) is var array
                && type.IsInstanceOfType(array) ? array
            : Create(type));
    }

    private object? Known(Type type) =>
        type == typeof(string) ? _folder[$"a{_ending}"]
        : type == typeof(Mesh) ? Shapes.Cube()
        : type == typeof(Fractal) ? Fractal.Of(Shapes.Cube()).Repeat([Transformation.At(Vector.I, 0.5)], 3)
        : type == typeof(FractalStep) ? TransformationSet.Of([Transformation.At(Vector.I, 0.5)])
        : type == typeof(Collider) ? Collider.For(Shapes.Cube())
        : type == typeof(Model) ? Model.Of(Shapes.Cube())
        : type == typeof(Scene) ? new Scene { Objects = [new(Shapes.Cube())] }
        : type == typeof(LoadedScene) ? LoadedScene.Of(new Scene { Objects = [new(Shapes.Cube())] })
        : type == typeof(Camera) ? Camera.Default
        : type == typeof(Stream) ? new MemoryStream()
        : type == typeof(TextWriter) ? new StringWriter()
        : null;

    private static Delegate EmptyDelegate(Type type)
    {
        var invoke = type.GetMethod("Invoke")!;
        var parameters = invoke.GetParameters().Select(parameter => Expression.Parameter(parameter.ParameterType));
        return Expression.Lambda(type, Expression.Default(invoke.ReturnType), parameters).Compile();
    }

    private object? Create(Type type)
    {
        var constructor = type.IsAbstract ? null : type.GetConstructors().MinBy(known => known.GetParameters().Length);
        if (constructor is not null)
        {
            return constructor.Invoke([.. constructor.GetParameters().Select(parameter => Sample(parameter.ParameterType))]);
        }

        var factory = type.GetMethods(BindingFlags.Public | BindingFlags.Static)
            .Where(method => method.ReturnType == type && !method.IsGenericMethod)
            .Where(method => method.GetParameters().All(parameter => parameter.ParameterType != type))
            .MinBy(method => method.GetParameters().Length) ?? throw new NotSupportedException(type.Name);
        return factory.Invoke(null, [.. factory.GetParameters().Select(parameter => Sample(parameter.ParameterType))]);
    }
}
