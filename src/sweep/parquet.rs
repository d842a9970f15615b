//! Columns as Parquet and back: one row group a chunk, gzip, the same bytes for the same columns.

use std::io::Write;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

use parquet::basic::{Compression, GzipLevel, LogicalType, Repetition, Type as Physical};
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterVersion};
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::file::writer::{
    SerializedColumnWriter, SerializedFileWriter, SerializedRowGroupWriter,
};
use parquet::schema::types::{Type, TypePtr};

use super::columns::{Cell, Column, Storage, word};

/// What a file says about itself besides its columns.
pub type Notes = Vec<(String, String)>;

/// Beginning of the key under which the unit of a column stands.
const UNIT: &str = "vinesink.unit.";

/// A file with one row group.
///
/// # Errors
/// [`ParquetError`] of the library.
pub fn file(columns: &[Column], notes: &Notes) -> Result<Vec<u8>, ParquetError> {
    let mut writer = begin(Vec::new(), columns, notes)?;
    append(&mut writer, columns)?;
    writer.into_inner()
}

/// Begins a file; `columns` are those of any of its row groups, and may be empty.
///
/// # Errors
/// [`ParquetError`] of the library.
pub fn begin<W: Write + Send>(
    sink: W,
    columns: &[Column],
    notes: &Notes,
) -> Result<SerializedFileWriter<W>, ParquetError> {
    SerializedFileWriter::new(sink, schema(columns)?, properties(columns, notes)?)
}

/// Adds a row group.
///
/// # Errors
/// [`ParquetError`] of the library, and where the columns are not those of the file.
pub fn append<W: Write + Send>(
    writer: &mut SerializedFileWriter<W>,
    columns: &[Column],
) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for column in columns {
        write(&mut group, column)?;
    }
    group.close().map(drop)
}

fn schema(columns: &[Column]) -> Result<TypePtr, ParquetError> {
    let fields = columns.iter().map(|column| {
        let (physical, logical) = match column.storage {
            Storage::Number => (Physical::DOUBLE, None),
            Storage::Whole => (Physical::INT64, None),
            Storage::Flag => (Physical::BOOLEAN, None),
            Storage::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        Type::primitive_type_builder(&column.name, physical)
            .with_logical_type(logical)
            .with_repetition(Repetition::OPTIONAL)
            .build()
            .map(Arc::new)
    });
    let fields = fields.collect::<Result<Vec<TypePtr>, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder("sweep").with_fields(fields).build()?))
}

fn properties(columns: &[Column], notes: &Notes) -> Result<Arc<WriterProperties>, ParquetError> {
    let units = columns.iter().map(|column| {
        KeyValue::new(format!("{UNIT}{}", column.name), Some(column.unit.to_owned()))
    });
    let notes = notes.iter().map(|(key, value)| KeyValue::new(key.clone(), Some(value.clone())));
    Ok(Arc::new(
        WriterProperties::builder()
            .set_compression(Compression::GZIP(GzipLevel::default()))
            .set_writer_version(WriterVersion::PARQUET_1_0)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_offset_index_disabled(true)
            .set_created_by(concat!("vinesink version ", env!("CARGO_PKG_VERSION")).to_owned())
            .set_key_value_metadata(Some(notes.chain(units).collect()))
            .build(),
    ))
}

fn write<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    Column { storage, cells, .. }: &Column,
) -> Result<(), ParquetError> {
    let missing = || ParquetError::General("more columns than the schema has".into());
    let mut writer = group.next_column()?.ok_or_else(missing)?;
    let to = &mut writer;
    match storage {
        Storage::Number => put::<DoubleType>(to, cells, Cell::number),
        Storage::Whole => put::<Int64Type>(to, cells, |cell| Some(cell.number()? as i64)),
        Storage::Flag => put::<BoolType>(to, cells, |cell| Some(cell.number()? != 0.0)),
        Storage::Text => put::<ByteArrayType>(to, cells, |cell| cell.text().map(ByteArray::from)),
    }?;
    writer.close()
}

fn put<T: DataType>(
    writer: &mut SerializedColumnWriter<'_>,
    cells: &[Option<Cell>],
    value: impl Fn(Cell) -> Option<T::T>,
) -> Result<(), ParquetError> {
    let there: Vec<T::T> = cells.iter().flatten().filter_map(|cell| value(*cell)).collect();
    let levels: Vec<i16> = cells.iter().map(|cell| i16::from(cell.is_some())).collect();
    writer.typed::<T>().write_batch(&there, Some(&levels), None)?;
    Ok(())
}

/// The longest that reading a chunk may take; it takes milliseconds.
const LONGEST: Duration = Duration::from_secs(5);

/// Adds what is in a file with one row group to columns, which are those of its sweep; it has at most so many rows.
///
/// # Errors
/// [`ParquetError`] of the library, if it is no such file or has other columns, or cannot be read in five seconds.
pub fn read<R: ChunkReader + Send + 'static>(
    file: R,
    columns: &mut [Column],
    most: usize,
) -> Result<(), ParquetError> {
    let damaged = || ParquetError::General("the file is damaged".into());
    let storages: Vec<Storage> = columns.iter().map(|column| column.storage).collect();
    // The library asserts what a damaged file need not hold, and says so on standard error; and what it does not know in
    // the head of a page it passes over element by element, billions if the head says so. Such a thread ends with the
    // process.
    let told = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let (done, read) = channel();
    thread::spawn(move || {
        let read = panic::catch_unwind(AssertUnwindSafe(|| read_group(file, &storages, most)));
        // Nobody may wait any more.
        let _ = done.send(read);
    });
    let read = read.recv_timeout(LONGEST);
    panic::set_hook(told);
    let cells = read.map_err(|_| damaged())?.map_err(|_| damaged())??;
    for (column, more) in columns.iter_mut().zip(cells) {
        column.cells.extend(more);
    }
    Ok(())
}

fn read_group<R: ChunkReader + 'static>(
    file: R,
    storages: &[Storage],
    most: usize,
) -> Result<Vec<Vec<Option<Cell>>>, ParquetError> {
    let file = SerializedFileReader::new(file)?;
    let group = file.get_row_group(0)?;
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
    if group.num_columns() != storages.len() || rows > most {
        return Err(ParquetError::General("the file has other columns or too many rows".into()));
    }
    let column = |(index, storage): (usize, &Storage)| {
        let pages = Bounded { pages: group.get_column_page_reader(index)?, rows };
        let description = group.metadata().schema_descr().column(index);
        cells(get_column_reader(description, Box::new(pages)), *storage, rows)
    };
    storages.iter().enumerate().map(column).collect()
}

/// Pages of a column that has so many rows: none has more values, whatever its head says, for which the library would take
/// memory.
struct Bounded {
    pages: Box<dyn PageReader>,
    rows: usize,
}

impl Iterator for Bounded {
    type Item = Result<Page, ParquetError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for Bounded {
    fn get_next_page(&mut self) -> Result<Option<Page>, ParquetError> {
        let page = self.pages.get_next_page()?;
        match &page {
            Some(page) if page.num_values() as usize > self.rows => {
                Err(ParquetError::General("a page has more values than the file has rows".into()))
            }
            _ => Ok(page),
        }
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>, ParquetError> {
        self.pages.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<(), ParquetError> {
        self.pages.skip_next_page()
    }
}

fn cells(
    reader: ColumnReader,
    storage: Storage,
    rows: usize,
) -> Result<Vec<Option<Cell>>, ParquetError> {
    let other = |what: &str| ParquetError::General(format!("the file has {what}"));
    match (reader, storage) {
        (ColumnReader::DoubleColumnReader(reader), Storage::Number) => {
            take(reader, rows, |number| Ok(Cell::Number(number)))
        }
        (ColumnReader::Int64ColumnReader(reader), Storage::Whole) => {
            take(reader, rows, |number| Ok(Cell::Number(number as f64)))
        }
        (ColumnReader::BoolColumnReader(reader), Storage::Flag) => {
            take(reader, rows, |flag| Ok(Cell::Number(f64::from(flag))))
        }
        (ColumnReader::ByteArrayColumnReader(reader), Storage::Text) => {
            let known = |text: ByteArray| word(text.data()).map(Cell::Text);
            take(reader, rows, |text| known(text).ok_or_else(|| other("other words")))
        }
        _ => Err(other("a column of another kind")),
    }
}

/// The cells of a column of a row group, nothing where a value is missing.
fn take<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    cell: impl Fn(T::T) -> Result<Cell, ParquetError>,
) -> Result<Vec<Option<Cell>>, ParquetError> {
    let (mut there, mut levels) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    reader.read_records(rows, Some(&mut levels), None, &mut there)?;
    let mut there = there.into_iter();
    let next = |level| if level == 1 { there.next().map(&cell).transpose() } else { Ok(None) };
    levels.into_iter().map(next).collect()
}
