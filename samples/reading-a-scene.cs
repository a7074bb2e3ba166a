#:project ../FractalEngine.Parsing/FractalEngine.Parsing.csproj
#:property PublishAot=false
// Loads a scene with all its files, lists its objects, and finds the one closest to the camera. Run from the folder of README.md.
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Views;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;


var file = AssetLoader.Load("assets/scenes/menger.sdo");
foreach (var placed in file.Scene.Objects)
{
    var faces = placed.Model.FaceCount is { } count ? $"{count}" : "infinitely many";
    Console.WriteLine($"{placed.Declaration.DisplayName}: {faces} faces from {placed.Model.FileBytes} bytes");
}

var camera = file.Scene.Scene.Camera ?? CameraFraming.Default(file.Scene.Scene);
var hit = Collider.For(file.Scene).FindClosest(camera.Position);
var closest = file.Scene.Objects[hit.ObjectIndex].Declaration;
Console.WriteLine(FormattableString.Invariant($"closest to the camera: {closest.DisplayName}, {hit.Distance:F9} away"));

// What is wrong with a file is told with its place, and by one root of all errors: FractalEngineException.
try
{
    AssetLoader.Load("assets/scenes/missing.sdo");
}
catch (SourceException exception)
{
    Console.WriteLine($"{exception.Kind}: {exception.Message}");
}

// Output:
// sponge: 38400000 faces from 1827 bytes
// closest to the camera: sponge, 1.149086594 away
// Input: assets/scenes/missing.sdo:1:1: error: file not found
